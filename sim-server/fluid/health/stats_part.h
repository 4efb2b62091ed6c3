// SPDX-License-Identifier: MIT
// Health and limits of one part of the fluid (reduce_stats.cl); the host sums them up.
#ifndef SPLASH_STATS_PART_H
#define SPLASH_STATS_PART_H

#include "sim-server/device/shared_struct.h"

#ifdef __cplusplus
namespace splash::sim {
#endif

typedef struct {
  float speed2;         // largest [m2/s2]
  float acceleration2;  // largest [m2/s4]
  float excess_sum;     // of max(rho / rho0 - 1, 0)
  float excess_max;
  int not_finite;  // particles with a coordinate, speed or density that is no number
  int first_bad;   // the smallest id of such a particle, 2^31 - 1: none
  int runaway;     // particles at the speed limit
  int asleep;      // particles that did not take part in the last step
  float lower[3];  // box around all particles [m]
  float upper[3];
} FluidStatsPart;
SPLASH_SHARED_STRUCT(FluidStatsPart, 56)

#ifdef __cplusplus
}  // namespace splash::sim
#endif

#endif
