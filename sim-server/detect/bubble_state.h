// SPDX-License-Identifier: MIT
// What the device finds of bubbles in a frame: of those that live (bubble_state.cl), where new ones
// are spawned (bubble_spawn.cl), and where air is folded in (air_fold.cl).
#ifndef SPLASH_BUBBLE_STATE_H
#define SPLASH_BUBBLE_STATE_H

#include "sim-server/device/shared_struct.h"

// What a particle remembers in place of its last upward gradient: it was slow; it has spawned and
// not calmed down since.
#define SPLASH_PARTICLE_SLOW -8.0f
#define SPLASH_PARTICLE_SPENT 8.0f

// One particle in this many is examined for air that is folded in, other ones in each frame
// (air_fold.cl).
#define SPLASH_FOLDS_APART 4

// A bubble that is in no group (cavity_grow.cl).
#define SPLASH_UNLABELLED 0x7FFFFFFF

#ifdef __cplusplus
namespace splash::sim {
#endif

typedef struct {
  float colour;   // c_b: other bubbles only [1]
  float upward;   // gradient of c_p, in that of a flat surface [1]
  float x, y, z;  // after the frame [m]
  int id;         // place in the pool
} BubbleState;
SPLASH_SHARED_STRUCT(BubbleState, 24)

typedef struct {
  int id;         // of the particle
  float x, y, z;  // [m]
  float before;   // part of the frame that had passed when the threshold was crossed; below zero:
                  // not known
} Spawn;
SPLASH_SHARED_STRUCT(Spawn, 20)

typedef struct {
  int id;         // of the particle
  float x, y, z;  // [m]
  float rate;     // of the air that it folds in [m3/s]
} AirFold;
SPLASH_SHARED_STRUCT(AirFold, 20)

#ifdef __cplusplus
}  // namespace splash::sim
#endif

#endif
