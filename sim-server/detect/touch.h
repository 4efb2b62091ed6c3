// SPDX-License-Identifier: MIT
// A point of a body's skin, and what it sees of the water (body_touch.cl).
#ifndef SPLASH_TOUCH_H
#define SPLASH_TOUCH_H

#include "sim-server/device/shared_struct.h"

#ifdef __cplusplus
namespace splash::sim {
#endif

typedef struct {
  float colour;                     // c_f of bodies of water [1]
  float gx, gy, gz;                 // its gradient: points into the water [1/m]
  float x, y, z;                    // of the point [m]
  float u, v, w;                    // its velocity [m/s]
  float water_u, water_v, water_w;  // the water's mean velocity [m/s]
  float nx, ny, nz;                 // unit vector out of the body
  float ahead;                      // matter some way along it: 1 in water without end [1]
  float all_colour;                 // c_f of all particles, spray and films among them [1]
} Touch;
SPLASH_SHARED_STRUCT(Touch, 72)

#ifdef __cplusplus
}  // namespace splash::sim
#endif

#endif
