// SPDX-License-Identifier: MIT
// Which cell a point is in, and which runs of sorted points its neighbours are in. Cells are as
// wide as the support and sorted x fastest, so the cells around a point are nine runs. Along x each
// cell is cut into slices: runs end closer to the support, and points that follow each other lie
// close together. Points beyond the grid count to its outermost inner cells: no point is lost, no
// index leaves the arrays.

#include "sim-server/fluid/params/fluid_params.h"

#define SLICES SPLASH_SLICES

// Slices of all cells.
static int all_cells(constant FluidParams* p) {
  return p->cells_x * SLICES * p->cells_y * p->cells_z;
}

static int cell_along(float x, float origin, float inverse_cell, int cells) {
  // Clamped before it becomes an integer: NaN and infinity land in the grid, too.
  return (int)fmin(fmax((x - origin) * inverse_cell, 1.0f), (float)(cells - 2));
}

static int slice_x(constant FluidParams* p, float x) {
  const float cell = fmin(fmax((x - p->origin_x) * p->inverse_cell, 1.0f), (float)p->cells_x);
  return min((int)(cell * SLICES), (p->cells_x - 1) * SLICES - 1);
}

// Row of cells along x that a point is in.
static int cell_row(constant FluidParams* p, float y, float z) {
  return cell_along(z, p->origin_z, p->inverse_cell, p->cells_z) * p->cells_y +
         cell_along(y, p->origin_y, p->inverse_cell, p->cells_y);
}

// Run number `k` (0..8) around slices `from` to `to` of a row: first point and the one past the
// last.
static int2 neighbour_run(constant FluidParams* p, global const int* cell_start, int row, int from,
                          int to, int k) {
  const int base = (row + (k / 3 - 1) * p->cells_y + k % 3 - 1) * p->cells_x * SLICES;
  return (int2)(cell_start[base + from - SLICES], cell_start[base + to + SLICES + 1]);
}

// The cells that a box lies in: slices `from` to `to` of each row.
typedef struct {
  int from, to, low_y, high_y, low_z, high_z;
} RowBox;

static RowBox rows_of_box(constant FluidParams* p, float3 lower, float3 upper) {
  const RowBox box = {slice_x(p, lower.x),
                       slice_x(p, upper.x),
                       cell_along(lower.y, p->origin_y, p->inverse_cell, p->cells_y),
                       cell_along(upper.y, p->origin_y, p->inverse_cell, p->cells_y),
                       cell_along(lower.z, p->origin_z, p->inverse_cell, p->cells_z),
                       cell_along(upper.z, p->origin_z, p->inverse_cell, p->cells_z)};
  return box;
}

// The run of points in one row of the box: the first, and the one past the last.
static int2 run_of_row(constant FluidParams* p, global const int* cell_start, RowBox box, int y,
                       int z) {
  const int base = (z * p->cells_y + y) * p->cells_x * SLICES;
  return (int2)(cell_start[base + box.from], cell_start[base + box.to + 1]);
}

// How far the sort for CPUs goes through the cells (cell_count.cl).

// Most cells lie above the water: past the last one in use nothing is counted or placed, and
// cell_start says `points` since the last whole sort. extent[chunk]: one past the last cell in use
// by the chunk; extent[chunks] and the next: by all of them, and how far the cells were gone
// through, both in the last sort. `whole`: that is not known, all cells are gone through.

// Cells to go through: those in use now, and those of last time.
static int cells_in_use(constant FluidParams* p, global const int* extent, int chunks, int whole) {
  if (whole) return all_cells(p);
  int most = 0;
  for (int k = 0; k <= chunks; ++k) most = max(most, extent[k]);
  return most;
}
