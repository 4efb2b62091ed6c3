// SPDX-License-Identifier: MIT
// Sort for CPUs, second half: every point to its place, cells in order, x fastest. `source`: where
// each came from.

#include "sim-server/fluid/lanes/lanes.h"
#include "sim-server/fluid/neighbours/grid.h"
#include "sim-server/fluid/neighbours/points.h"
#include "sim-server/fluid/params/fluid_params.h"

#if LANES > 1
// Points that stay next to each other, as most do from step to step, LANES of them.
static void move_together(int stride, global const float* position, global const float* velocity,
                          global const int* id, int i, const Points* out, global int* source,
                          int to) {
  for (int axis = 0; axis < 3; ++axis) {
    STORE(LOAD(position + axis * stride, i), out->position + axis * stride, to);
    STORE(LOAD(velocity + axis * stride, i), out->velocity + axis * stride, to);
  }
  STORE(LOAD(id, i), out->id, to);
  STORE(LANE_NUMBERS + i, source, to);
}
#endif

kernel void sort_points(constant FluidParams* p, int points, int stride, int chunks, int whole,
                        global const int* cells, global int* place,
                        global const float* position, global const float* velocity,
                        global const int* id, global float* position_out,
                        global float* velocity_out, global int* id_out, global int* source,
                        global int* extent) {
  const int chunk = get_global_id(0);
  if (chunk >= chunks) return;
  const int cell_count = all_cells(p);
  if (chunk == 0) {  // for the next sort
    extent[chunks + 1] = cells_in_use(p, extent, chunks, whole);
    extent[chunks] = 0;
    extent[chunks] = cells_in_use(p, extent, chunks, 0);
  }
  global int* mine = place + (size_t)chunk * cell_count;
  const Points out = {position_out, velocity_out, id_out};
  const int size = (points + chunks - 1) / chunks;
  const int last = min((chunk + 1) * size, points);
  int i = chunk * size;
#if LANES > 1
  for (; i + LANES <= last; i += LANES) {
    int to[LANES], apart = 0;
    for (int lane = 0; lane < LANES; ++lane) {
      to[lane] = mine[cells[i + lane]]++;
      apart |= to[lane] - to[0] - lane;
    }
    if (apart == 0) {
      move_together(stride, position, velocity, id, i, &out, source, to[0]);
      continue;
    }
    for (int lane = 0; lane < LANES; ++lane) {
      move_point(stride, position, velocity, id, i + lane, &out, source, to[lane]);
    }
  }
#endif
  for (; i < last; ++i) {
    move_point(stride, position, velocity, id, i, &out, source, mine[cells[i]]++);
  }
}
