// SPDX-License-Identifier: MIT
// Groups that a step has no work for rest: all their water sleeps, and no body is near. They have
// the density that they had, no acceleration, and do not move; the stages that follow pass them
// over. `resting`: of each group, for how many steps it has rested and nobody in it has changed
// place, 0: it is at work. Once it has RESTED for so many, both halves of the double buffers hold
// its numbers, and nothing is left to do.

#include "sim-server/fluid/boundary/bodies.h"
#include "sim-server/fluid/lanes/lanes.h"
#include "sim-server/fluid/neighbours/grid.h"
#include "sim-server/fluid/params/fluid_params.h"
#include "sim-server/fluid/params/parts.h"
#include "sim-server/fluid/sleep/sleep.h"

#define RESTED 3

// Along one axis, where cells `from` to `to` lie; whoever is beyond the grid counts to its
// outermost inner cells. Wider by a slice, for rounding [m].
static float2 reach_of_cells(float origin, float inverse_cell, int cells, int from, int to) {
  const float slack = 1.0f / SLICES;
  return (float2)(from <= 1 ? -FAR_AWAY : origin + (from - slack) / inverse_cell,
                  to >= cells - 2 ? FAR_AWAY : origin + (to + 1 + slack) / inverse_cell);
}

static bool bodies_near_cells(constant FluidParams* p, global const BodyStep* bodies,
                              int first_body, int body_count, int row, int from, int to) {
  if (!HAS_BODIES) return false;
  const int y = row % p->cells_y, z = row / p->cells_y;
  const float2 xs = reach_of_cells(p->origin_x, p->inverse_cell, p->cells_x, from, to);
  const float2 ys = reach_of_cells(p->origin_y, p->inverse_cell, p->cells_y, y, y);
  const float2 zs = reach_of_cells(p->origin_z, p->inverse_cell, p->cells_z, z, z);
  return bodies_near_box(bodies, first_body, body_count, (float3)(xs.x, ys.x, zs.x),
                         (float3)(xs.y, ys.y, zs.y));
}

// Whether any of the particles `first` to `last` moves, has its density kept up or is near a body.
static bool has_work(constant FluidParams* p, global const int* cell_start,
                     global const int* activity, global const float* position,
                     global const BodyStep* bodies, int first_body, int body_count, int first,
                     int last) {
  const int n = p->capacity;
  for (int turn = first; turn < last;) {
    const int row = cell_row(p, position[n + turn], position[2 * n + turn]);
    const int next = max(turn + 1, min(last, cell_start[(row + 1) * p->cells_x * SLICES]));
    const int from = slice_x(p, position[turn]) / SLICES;
    const int to = slice_x(p, position[next - 1]) / SLICES;
    if (activity_in(p, activity, row, from, to) > 0 ||
        bodies_near_cells(p, bodies, first_body, body_count, row, from, to)) {
      return true;
    }
    turn = next;
  }
  return false;
}

static bool in_their_places(global const int* source, int first, int last) {
  int moved = 0;
  for (int i = first; i < last; ++i) moved |= source[i] ^ i;
  return moved == 0;
}

// For how many steps the group of the particles `first` to `last` has rested now.
static int rested(constant FluidParams* p, global const int* cell_start, global const int* activity,
                  global const int* source, global const float* position,
                  global const BodyStep* bodies, int first_body, int body_count, int before,
                  int first, int last) {
  if (has_work(p, cell_start, activity, position, bodies, first_body, body_count, first, last)) {
    return 0;
  }
  return in_their_places(source, first, last) ? min(before + 1, RESTED) : 1;
}
