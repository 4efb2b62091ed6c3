// SPDX-License-Identifier: MIT
// What surrounds the iterations of the two solves of a step: where they begin, whether they are
// done, and what they leave behind. Pressures (p / rho^2, as everywhere) are kept by particle id
// from step to step.

#include "sim-server/fluid/params/fluid_params.h"
#include "sim-server/fluid/pressure/divergence_free/solve_state.h"

// Of rest density: what is less dense makes no demands on the divergence of its motion (instead of
// counting neighbours: Bender & Koschier 2017 ask for 20). On the lattice the top layer of a flat
// surface has 0.88, a sheet of one layer 0.75.
#define SPARSE 0.85f

// Each particle's pressure of the last step, in this step's order.
kernel void recall_pressure(constant FluidParams* p, global const int* id,
                            global const float* kept, global float* pressure) {
  const int i = get_global_id(0);
  if (i < p->count) pressure[i] = kept[id[i]];
}

// Motion is to stop compressing; from no pressure at all.
kernel void begin_divergence_solve(constant FluidParams* p, global const float* density,
                                   global const float* velocity, global float* guess,
                                   global float* offset, global float* pressure) {
  const int i = get_global_id(0);
  if (i >= p->count) return;
  const int n = p->capacity;
  for (int axis = 0; axis < 3; ++axis) guess[axis * n + i] = velocity[axis * n + i];
  offset[i] = density[i] < SPARSE * p->rest_density ? -1.0e3f * p->rest_density : 0.0f;
  pressure[i] = 0.0f;
}

// Densities are to be at rest; from pressures that the acceleration holds already.
kernel void begin_density_solve(constant FluidParams* p, float dt, global const float* density,
                                global const float* acceleration, global float* guess,
                                global float* offset) {
  const int i = get_global_id(0);
  if (i >= p->count) return;
  const int n = p->capacity;
  for (int axis = 0; axis < 3; ++axis) guess[axis * n + i] += dt * acceleration[axis * n + i];
  offset[i] = density[i] - p->rest_density;
}

// Acceleration from first to last velocity, and the pressures kept: `warm` is what the next density
// solve starts from, a mean over 1 / follow steps; `pushed` is all that did in this step.
kernel void end_solves(constant FluidParams* p, float dt, float follow, global const int* id,
                       global const float* velocity, global const float* guess,
                       global const float* divergence_pressure, global float* pressure,
                       global float* warm, global float* pushed, global float* acceleration) {
  const int i = get_global_id(0);
  if (i >= p->count) return;
  const int n = p->capacity;
  for (int axis = 0; axis < 3; ++axis) {
    acceleration[axis * n + i] = (guess[axis * n + i] - velocity[axis * n + i]) / dt;
  }
  warm[id[i]] += follow * (pressure[i] - warm[id[i]]);
  pressure[i] += divergence_pressure[i];
  pushed[id[i]] = pressure[i];
}

// Judges the errors that the corrections of iteration `k` found; one work-group of at most JUDGES,
// sums in a fixed order: each item's of a stretch, or, in teams, of every so manieth. Done when
// their mean is within the tolerance, not before `least` iterations.
kernel void judge_solve(constant FluidParams* p, int parts, int k, int least, int most,
                        global const float* error_part, global SolveState* state) {
  local float sums[JUDGES], numbers[JUDGES];
  if (is_done(state, k)) return;
  const int item = get_local_id(0), items = get_local_size(0);
  const int size = (parts + items - 1) / items;
  const int first = TEAM > 1 ? item : item * size, step = TEAM > 1 ? items : 1;
  const int last = TEAM > 1 ? parts : min((item + 1) * size, parts);
  float sum = 0.0f, number = 0.0f;
  for (int i = first; i < last; i += step) {
    sum += error_part[2 * i];
    number += error_part[2 * i + 1];
  }
  sums[item] = sum;
  numbers[item] = number;
  barrier(CLK_LOCAL_MEM_FENCE | CLK_GLOBAL_MEM_FENCE);  // all have read the state
  if (item > 0) return;
  SolveState s = *state;
  if (k == 0) {
    s.done = 0;
    s.iterations = 0;
    ++s.solves;
  }
  for (int i = 1; i < items; ++i) {
    sum += sums[i];
    number += numbers[i];
  }
  s.error = sum / (fmax(number, 1.0f) * p->rest_density);
  s.done = k >= least && s.error <= p->tolerance;
  if (!s.done) {
    ++s.iterations;
    ++s.total;
    s.most = max(s.most, s.iterations);
    s.given_up += k == most - 1;
  }
  *state = s;
}
