// SPDX-License-Identifier: MIT
// In the axes of a tank that turns (scene/tank_motion.hpp), before a step of dt:
//   v = exp(-2 dt [w]x) v - dt ([w']x + [w]x [w]x) r
// Coriolis' force turns velocities, which keep their length; Euler's and the centrifugal force
// push. Gravity and the pivot's acceleration, the same everywhere, are in FluidParams. All solvers
// find the velocities so, and their pressures answer.

#include "sim-server/fluid/lanes/lanes.h"
#include "sim-server/fluid/params/fluid_params.h"
#include "sim-server/fluid/pressure/tank_turn.h"

static lanes row_times(global const float* row, lanes x, lanes y, lanes z) {
  return row[0] * x + row[1] * y + row[2] * z;
}

kernel void turn_water(constant FluidParams* p, global const TankTurn* turn,
                       global const float* position, global float* velocity) {
  const int n = p->capacity;
  const int i = get_global_id(0) * LANES;
  if (i >= p->count) return;
  const lanes x = LOAD(position, i) - turn->px;
  const lanes y = LOAD(position + n, i) - turn->py;
  const lanes z = LOAD(position + 2 * n, i) - turn->pz;
  const lanes u = LOAD(velocity, i), v = LOAD(velocity + n, i), w = LOAD(velocity + 2 * n, i);
  for (int axis = 0; axis < 3; ++axis) {
    const lanes turned = row_times(turn->turned + 3 * axis, u, v, w);
    STORE(turned + row_times(turn->pushed + 3 * axis, x, y, z), velocity + axis * n, i);
  }
}
