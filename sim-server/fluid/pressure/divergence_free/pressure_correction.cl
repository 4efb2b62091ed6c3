// SPDX-License-Identifier: MIT
// First half of an iteration: what the velocities would do to densities within the step, and by how
// much each particle's pressure has to change:
//   error_i = offset_i + dt Drho_i/Dt                      [kg/m3]
//   Q_i     = within(P_i + omega error_i / (dt^2 D_i))      relaxed Jacobi
//   P_i     = within(Q_i + beta (Q_i - last Q_i))          Nesterov's momentum
// with offset rho_i - rho0 where densities are to be at rest after the step, and 0 where motion is
// to stop compressing (Bender & Koschier 2017, sections 3.3 and 3.4). A particle with a sparse
// neighbourhood does not compress by coming closer: its offset is very low. Particles that sleep
// keep their pressures.
// Pressures stay within 0 and what the step was made for. It lets nothing go farther than s
// spacings (FluidParams::advective_cfl), so that the fastest has u = s dx / dt; the most that it
// may need is the push that stops it within a step over a spacing, p = rho0 u dx / dt, P = s
// (dx/dt)^2 / rho0.
// That is u^2 / s in terms of its speed, 7 times its stagnation pressure (3 at twice the default
// step), and as u is sqrt(g H) at least, never less than what the deepest water weighs. A particle
// that two solids pinch is freed by no pressure, and without the bound got all there is.

#include "sim-server/fluid/lanes/lanes.h"
#include "sim-server/fluid/neighbours/group.h"
#include "sim-server/fluid/neighbours/near.h"
#include "sim-server/fluid/neighbours/pair.h"
#include "sim-server/fluid/params/fluid_params.h"
#include "sim-server/fluid/params/smoothing.h"
#include "sim-server/fluid/pressure/divergence_free/solve_state.h"
#include "sim-server/fluid/sleep/sleep.h"

// The inverse of the largest eigenvalue of the system scaled by its diagonal: 2.7 on the lattice,
// 3.3 when it is shaken by 0.2 spacings, 4 at random places.
#define RELAXATION 0.3f

// Sum of m v_j . grad W_ij, divided by -gradient_norm.
static lanes carried_by_fluid(constant FluidParams* p, const Group* g, global const int* cell_start,
                              global const float* position, global const float* velocity) {
  const int n = p->capacity;
  lanes sum = 0.0f;
  Near near;
  begin_search(&near);
  while (search(p, g, cell_start, position, n, &near)) {
    for (int k = 0; k < near.count; ++k) {
      const int j = NEAR(near, k);
      const Pair pair = pair_with(p, g, position, n, j);
      sum += pair.slope *
             (velocity[j] * pair.dx + velocity[n + j] * pair.dy + velocity[2 * n + j] * pair.dz);
    }
  }
  return p->mass * sum;
}

// What a correction reads of each particle, and what it writes.
typedef struct {
  global const float* velocity;
  global const float* gradient;
  global const float* response;
  global const float* boundary_rate;
  global const float* offset;
  global const float* pressure;
  global float* jacobi;
  global float* change;
} Iterate;

// Of the particles `first` to `last` (not included) that move, the sum of what Jacobi's step
// answers to, which is errors but not those below zero of particles without pressure [kg/m3]; and
// their number.
static float2 correct(constant FluidParams* p, int k, float beta, float dt,
                      global const int* cell_start, global const int* activity,
                      global const float* position, const Iterate* it, int first, int last) {
  const int n = p->capacity;
  const float scale = -gradient_norm(p);
  lanes carried = 0.0f;
  lane_flags moves = 0;
  for (int turn = first; turn < last;) {
    const Group g = load_group(p, cell_start, position, first, last, turn);
    if (activity_of(p, activity, &g) < SPLASH_ACTIVITY_MOTION) {
      turn = g.next;
      continue;
    }
    moves |= g.mine;
    carried = select(carried, carried_by_fluid(p, &g, cell_start, position, it->velocity), g.mine);
    turn = g.next;
  }
  const lanes own = LOAD(it->velocity, first) * LOAD(it->gradient, first) +
                    LOAD(it->velocity + n, first) * LOAD(it->gradient + n, first) +
                    LOAD(it->velocity + 2 * n, first) * LOAD(it->gradient + 2 * n, first);
  const lanes rate = own - scale * carried + LOAD(it->boundary_rate, first);
  const lanes error = LOAD(it->offset, first) + dt * rate;
  // A lone particle answers to no pressure, and gets next to none.
  const float least = scale * p->mass * SLOPE_UNIT;
  const lanes d = fmax(LOAD(it->response, first), 1.0e-4f * least * least);
  const lanes step = RELAXATION / (dt * dt) * error / d;
  const lanes now = LOAD(it->pressure, first);
  const lanes none = 0.0f, one = 1.0f;
  const float grid_speed = p->spacing / dt;
  const lanes most = p->advective_cfl * grid_speed * grid_speed / p->rest_density;
  const lanes better = clamp(now + step, none, most);
  const lanes before = k > 0 ? LOAD(it->jacobi, first) : now;
  STORE(better, it->jacobi, first);
  const lanes next = clamp(better + beta * (better - before), none, most);
  STORE(select(none, next - now, moves), it->change, first);
  const lanes found = fabs(better - now) * d * (dt * dt / RELAXATION);
  return (float2)(total(select(none, found, moves)), total(select(none, one, moves)));
}

// `jacobi`: Q. `error_part`: what was found, of each work-item, or of each work-group of a team.
kernel void correct_pressure(constant FluidParams* p, int k, global const SolveState* state,
                             float beta, float dt, global const int* cell_start,
                             global const int* activity, global const float* position,
                             global const float* velocity, global const float* gradient,
                             global const float* response, global const float* boundary_rate,
                             global const float* offset, global const float* pressure,
                             global float* jacobi, global float* change, global float* error_part) {
  if (is_done(state, k)) return;
  const int first = get_global_id(0) * LANES;
  const int last = min(first + LANES, p->count);
  const Iterate it = {velocity, gradient, response, boundary_rate,
                      offset,   pressure, jacobi,   change};
#if TEAM > 1
  local float2 of_team[TEAM];
  float2 found = (float2)(0.0f, 0.0f);
  if (first < last) {
    found = correct(p, k, beta, dt, cell_start, activity, position, &it, first, last);
  }
  of_team[get_local_id(0)] = found;
  barrier(CLK_LOCAL_MEM_FENCE);
  if (get_local_id(0) > 0) return;
  for (int item = 1; item < (int)get_local_size(0); ++item) found += of_team[item];
  vstore2(found, get_group_id(0), error_part);
#else
  if (first >= last) return;
  vstore2(correct(p, k, beta, dt, cell_start, activity, position, &it, first, last),
          get_global_id(0), error_part);
#endif
}
