// SPDX-License-Identifier: MIT
// What the grid does not see of the particles' velocities: d = v - S v, with S from the particles
// to the faces and back, which is symmetric and has eigenvalues from 0 to 1. What is above the grid
// deviates by nothing.

#include "sim-server/fluid/params/fluid_params.h"
#include "sim-server/fluid/pressure/grid_projected/mac_cell.h"
#include "sim-server/fluid/pressure/grid_projected/mac_grid.h"

// Mean of the faces around a particle, by the hat.
static float3 from_faces(constant MacGrid* g, const Placed* at, global const float* mean) {
  const int cells = g->level[0].cells;
  float part[3];
  for (int axis = 0; axis < 3; ++axis) {
    const Around a = around(g, at, axis);
    float sum = 0.0f;
    for (int k = 0; k < 8; ++k) sum += a.weight[k] * mean[axis * cells + a.cell[k]];
    part[axis] = sum;
  }
  return (float3)(part[0], part[1], part[2]);
}

kernel void find_deviation(constant FluidParams* p, constant MacGrid* g,
                           global const float* position, global const float* velocity,
                           global const float* mean, global float* deviation) {
  const int i = get_global_id(0);
  if (i >= p->count) return;
  const int n = p->capacity;
  const Placed at = place_on_grid(g, position[i], position[n + i], position[2 * n + i]);
  const float3 seen = from_faces(g, &at, mean);
  deviation[i] = at.on_grid ? velocity[i] - seen.x : 0.0f;
  deviation[n + i] = at.on_grid ? velocity[n + i] - seen.y : 0.0f;
  deviation[2 * n + i] = at.on_grid ? velocity[2 * n + i] - seen.z : 0.0f;
}
