// SPDX-License-Identifier: MIT
// Sort for devices of many small cores, one work-item for each point. Atomics count the points of
// each slice of a cell (called a cell here); the order in which they do it is any, so it only gives
// each point some place in its cell. Then each point counts those of its cell that came before it,
// by their old numbers: the sort is stable, and the same on every run.

#include "sim-server/fluid/neighbours/grid.h"
#include "sim-server/fluid/neighbours/points.h"
#include "sim-server/fluid/params/fluid_params.h"

// Cells that one work-item adds up at once.
#define RUN 16

// A slice of a cell holds four points at rest. Where so many are in one, there is no water any
// more: they keep the order that atomics gave them, or counting would take minutes.
#define CROWD 16384

// cells[i]: where each point is; arrival[i]: how many of its cell were counted before it.
kernel void count_points(constant FluidParams* p, int points, int stride,
                         global const float* position, global int* cells, global int* count,
                         global int* arrival) {
  const int i = get_global_id(0);
  if (i >= points) return;
  const int row = cell_row(p, position[stride + i], position[2 * stride + i]);
  const int c = row * p->cells_x * SLICES + slice_x(p, position[i]);
  cells[i] = c;
  arrival[i] = atomic_inc(count + c);
}

// Points in each block of `block` cells, one work-group for each.
kernel void sum_cells(constant FluidParams* p, int block, global const int* count,
                      global int* block_sum) {
  local int sums[TEAM];
  const int item = get_local_id(0), items = get_local_size(0), number = get_group_id(0);
  const int last = min((number + 1) * block, all_cells(p));
  int sum = 0;
  for (int c = number * block + item; c < last; c += items) sum += count[c];
  sums[item] = sum;
  barrier(CLK_LOCAL_MEM_FENCE);
  if (item > 0) return;
  for (int k = 1; k < items; ++k) sum += sums[k];
  block_sum[number] = sum;
}

// The sum of all items' values; `before`: of those of lower number.
static int add_up(int value, local int* values, int* before) {
  const int item = get_local_id(0), items = get_local_size(0);
  barrier(CLK_LOCAL_MEM_FENCE);  // all have read what the last sum left
  values[item] = value;
  barrier(CLK_LOCAL_MEM_FENCE);
  int sum = 0;
  *before = 0;
  for (int k = 0; k < items; ++k) {
    if (k == item) *before = sum;
    sum += values[k];
  }
  return sum;
}

// First point of each cell, and of one more. Leaves the counts at zero, for the next sort.
kernel void start_cells(constant FluidParams* p, int block, int points,
                        global const int* block_sum, global int* count,
                        global int* cell_start) {
  local int values[TEAM];
  const int item = get_local_id(0), items = get_local_size(0), number = get_group_id(0);
  const int cells = all_cells(p), last = min((number + 1) * block, cells);
  int place = 0, before = 0;
  for (int b = item; b < number; b += items) place += block_sum[b];
  place = add_up(place, values, &before);
  for (int tile = number * block; tile < last; tile += items * RUN) {
    const int first = tile + item * RUN;
    int here[RUN], sum = 0;
    for (int k = 0; k < RUN; ++k) {
      here[k] = first + k < last ? count[first + k] : 0;
      sum += here[k];
    }
    const int all = add_up(sum, values, &before);
    int start = place + before;
    for (int k = 0; k < RUN && first + k < last; ++k) {
      cell_start[first + k] = start;
      count[first + k] = 0;
      start += here[k];
    }
    place += all;
  }
  if (item == 0 && last == cells) cell_start[cells] = points;
}

// Points by cells, in any order within each.
kernel void gather_cells(int points, global const int* cells, global const int* cell_start,
                         global const int* arrival, global int* order) {
  const int i = get_global_id(0);
  if (i < points) order[cell_start[cells[i]] + arrival[i]] = i;
}

// Every point to its place.
kernel void rank_points(int points, int stride, global const int* cells,
                        global const int* cell_start, global const int* order,
                        global const float* position, global const float* velocity,
                        global const int* id, global float* position_out,
                        global float* velocity_out, global int* id_out, global int* source) {
  const int k = get_global_id(0);
  if (k >= points) return;
  const Points out = {position_out, velocity_out, id_out};
  const int i = order[k], cell = cells[i];
  const int first = cell_start[cell], last = cell_start[cell + 1];
  const bool crowd = last - first > CROWD;
  int to = crowd ? k : first;
  for (int j = first; j < last && !crowd; ++j) to += order[j] < i ? 1 : 0;
  move_point(stride, position, velocity, id, i, &out, source, to);
}
