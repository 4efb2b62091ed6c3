// SPDX-License-Identifier: MIT
// Second half of an iteration: velocities by the change of pressures,
//   v_i -= dt (change_i G_i + sum_j m change_j grad W_ij),
// which is the force of pressure/acceleration.cl: between particles equal and opposite; by bodies
// and walls with the particle's own pressure alone.

#include "sim-server/fluid/lanes/lanes.h"
#include "sim-server/fluid/neighbours/group.h"
#include "sim-server/fluid/neighbours/near.h"
#include "sim-server/fluid/neighbours/pair.h"
#include "sim-server/fluid/params/fluid_params.h"
#include "sim-server/fluid/params/smoothing.h"
#include "sim-server/fluid/pressure/divergence_free/solve_state.h"
#include "sim-server/fluid/sleep/sleep.h"

typedef struct {
  lanes x, y, z;
} Shove;

// Sum of m change_j grad W_ij, divided by -20 sigma / H^2.
static Shove shove_by_fluid(constant FluidParams* p, const Group* g, global const int* cell_start,
                            global const float* position, global const float* change) {
  Shove sum = {0.0f, 0.0f, 0.0f};
  Near near;
  begin_search(&near);
  while (search(p, g, cell_start, position, p->capacity, &near)) {
    for (int k = 0; k < near.count; ++k) {
      const int j = NEAR(near, k);
      const Pair pair = pair_with(p, g, position, p->capacity, j);
      const lanes f = p->mass * change[j] * pair.slope;
      sum.x += f * pair.dx;
      sum.y += f * pair.dy;
      sum.z += f * pair.dz;
    }
  }
  return sum;
}

kernel void push_by_pressure(constant FluidParams* p, int k, global const SolveState* state,
                             float dt, global const int* cell_start, global const int* activity,
                             global const float* position, global const float* gradient,
                             global const float* change, global float* pressure,
                             global float* velocity) {
  if (is_done(state, k)) return;
  const int n = p->capacity;
  const int first = get_global_id(0) * LANES;
  const int last = min(first + LANES, p->count);
  if (first >= last) return;
  const float scale = -gradient_norm(p);
  Shove shove = {0.0f, 0.0f, 0.0f};
  for (int turn = first; turn < last;) {
    const Group g = load_group(p, cell_start, position, first, last, turn);
    if (activity_of(p, activity, &g) < SPLASH_ACTIVITY_MOTION) {
      turn = g.next;
      continue;
    }
    const Shove by = shove_by_fluid(p, &g, cell_start, position, change);
    shove.x = select(shove.x, by.x, g.mine);
    shove.y = select(shove.y, by.y, g.mine);
    shove.z = select(shove.z, by.z, g.mine);
    turn = g.next;
  }
  const lanes own = LOAD(change, first);
  STORE(LOAD(pressure, first) + own, pressure, first);
  STORE(LOAD(velocity, first) - dt * (own * LOAD(gradient, first) + scale * shove.x), velocity,
        first);
  STORE(LOAD(velocity + n, first) - dt * (own * LOAD(gradient + n, first) + scale * shove.y),
        velocity + n, first);
  STORE(
      LOAD(velocity + 2 * n, first) - dt * (own * LOAD(gradient + 2 * n, first) + scale * shove.z),
      velocity + 2 * n, first);
}
