// SPDX-License-Identifier: MIT
// Sort for CPUs: how many points of each chunk fall into each slice of a cell (called a cell here),
// where each chunk's points of each begin, and every point to its place. A counting sort with one
// histogram per chunk needs no atomics, so its order, and with it every sum that follows, is the
// same on every run.

#include "sim-server/fluid/lanes/lanes.h"
#include "sim-server/fluid/neighbours/grid.h"
#include "sim-server/fluid/neighbours/points.h"
#include "sim-server/fluid/params/fluid_params.h"

// count[chunk][cell] for the points of one chunk; cells[i] is kept for sort_points.
kernel void count_cells(constant FluidParams* p, int points, int stride, int chunks, int whole,
                        global const float* position, global int* cells, global int* count,
                        global int* extent) {
  const int chunk = get_global_id(0);
  if (chunk >= chunks) return;
  const int cell_count = all_cells(p);
  global int* mine = count + (size_t)chunk * cell_count;
  const int filled = whole ? cell_count : extent[chunks + 1];
  for (int c = 0; c < filled; ++c) mine[c] = 0;
  int used = 0;
  const int size = (points + chunks - 1) / chunks;
  const int last = min((chunk + 1) * size, points);
  for (int i = chunk * size; i < last; ++i) {
    const int row = cell_row(p, position[stride + i], position[2 * stride + i]);
    const int c = row * p->cells_x * SLICES + slice_x(p, position[i]);
    cells[i] = c;
    ++mine[c];
    used = max(used, c + 1);
  }
  extent[chunk] = used;
}

// Points in each block of cells.
kernel void sum_blocks(constant FluidParams* p, int chunks, int blocks, int whole,
                       global const int* extent, global const int* count,
                       global int* block_sum) {
  const int block = get_global_id(0);
  if (block >= blocks) return;
  const int cell_count = all_cells(p), used = cells_in_use(p, extent, chunks, whole);
  const int size = (used + blocks - 1) / blocks;
  const int last = min((block + 1) * size, used);
  int sum = 0;
  for (int chunk = 0; chunk < chunks; ++chunk) {
    global const int* of_chunk = count + (size_t)chunk * cell_count;
    for (int c = block * size; c < last; ++c) sum += of_chunk[c];
  }
  block_sum[block] = sum;
}

// Exclusive prefix sums, cell by cell and within a cell chunk by chunk: count becomes the place
// of each chunk's first point, cell_start[c] that of each cell's.
kernel void place_cells(constant FluidParams* p, int chunks, int blocks, int whole,
                        global const int* extent, global const int* block_sum,
                        global int* count, global int* cell_start) {
  const int block = get_global_id(0);
  if (block >= blocks) return;
  const int cell_count = all_cells(p), used = cells_in_use(p, extent, chunks, whole);
  const int size = (used + blocks - 1) / blocks;
  const int last = min((block + 1) * size, used);
  int place = 0;
  for (int b = 0; b < block; ++b) place += block_sum[b];
  for (int c = block * size; c < last; ++c) {
    cell_start[c] = place;
    for (int chunk = 0; chunk < chunks; ++chunk) {
      global int* entry = count + (size_t)chunk * cell_count + c;
      const int here = *entry;
      *entry = place;
      place += here;
    }
  }
  if (block == blocks - 1) cell_start[used] = place;
}

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

// Every point to its place, cells in order, x fastest. `source`: where each came from.
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

// All of it, for one chunk: a few points take less time than the launches would.
kernel void sort_few(constant FluidParams* p, int points, int stride, int whole,
                     global const float* position, global const float* velocity,
                     global const int* id, global int* cells, global int* count,
                     global int* block_sum, global int* extent, global int* cell_start,
                     global float* position_out, global float* velocity_out, global int* id_out,
                     global int* source) {
  count_cells(p, points, stride, 1, whole, position, cells, count, extent);
  place_cells(p, 1, 1, whole, extent, block_sum, count, cell_start);
  sort_points(p, points, stride, 1, whole, cells, count, position, velocity, id, position_out,
              velocity_out, id_out, source, extent);
}
