// SPDX-License-Identifier: MIT
// Puts pinned particles back to their places, at rest; all others move freely.

#include "sim-server/fluid/params/fluid_params.h"

kernel void put_back(constant FluidParams* p, global const int* kept, global const float* place,
                     global const int* id, global float* position, global float* velocity) {
  const int i = get_global_id(0);
  if (i >= p->count || !kept[id[i]]) return;
  for (int axis = 0; axis < 3; ++axis) {
    position[axis * p->capacity + i] = place[axis * p->capacity + id[i]];
    velocity[axis * p->capacity + i] = 0.0f;
  }
}
