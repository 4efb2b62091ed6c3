// SPDX-License-Identifier: MIT
// How far the sort for CPUs goes through the cells (cell_count.cl, cell_sort.cl).

#include "sim-server/fluid/neighbours/grid.h"
#include "sim-server/fluid/params/fluid_params.h"

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
