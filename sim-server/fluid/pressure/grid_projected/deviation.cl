// SPDX-License-Identifier: MIT
// What the grid does not see of the particles' velocities: d = v - S v, with S from the particles
// to the faces and back, which is symmetric and has eigenvalues from 0 to 1. What is above the grid
// deviates by nothing.

#include "sim-server/fluid/lanes/lanes.h"
#include "sim-server/fluid/params/fluid_params.h"
#include "sim-server/fluid/pressure/grid_projected/mac_cell.h"
#include "sim-server/fluid/pressure/grid_projected/mac_grid.h"

kernel void find_deviation(constant FluidParams* p, constant MacGrid* g,
                           global const float* position, global const float* velocity,
                           global const float* mean, global float* deviation) {
  const int n = p->capacity;
  const int i = get_global_id(0) * LANES;
  if (i >= p->count) return;
  const Placed at =
      place_on_grid(g, LOAD(position, i), LOAD(position + n, i), LOAD(position + 2 * n, i));
  const lanes none = 0.0f;
  for (int axis = 0; axis < 3; ++axis) {
    const lanes unseen = LOAD(velocity + axis * n, i) - sum_of_faces(g, &at, axis, mean, 0).whole;
    STORE(select(none, unseen, at.on_grid), deviation + axis * n, i);
  }
}
