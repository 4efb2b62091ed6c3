// SPDX-License-Identifier: MIT
// What the walls do to each particle, as in the accelerations (fluid/pressure/acceleration.cl):
//   a_i = - p_i / rho_i^2  rho0  grad share_i          [m/s2]

#include "sim-server/fluid/boundary/walls.h"
#include "sim-server/fluid/lanes/lanes.h"
#include "sim-server/fluid/params/fluid_params.h"

kernel void push_by_walls(constant FluidParams* p, global const float* position,
                          global const float* pressure_term, float piston, global float* push) {
  const int n = p->capacity;
  const int first = get_global_id(0) * LANES;
  if (first >= p->count) return;
  const WallField wall = wall_field(p, LOAD(position, first), LOAD(position + n, first),
                                    LOAD(position + 2 * n, first), piston);
  const lanes own = LOAD(pressure_term, first) * p->rest_density;
  STORE(-own * wall.gx, push, first);
  STORE(-own * wall.gy, push + n, first);
  STORE(-own * wall.gz, push + 2 * n, first);
}
