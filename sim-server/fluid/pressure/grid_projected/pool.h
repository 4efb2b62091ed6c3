// SPDX-License-Identifier: MIT
// Rows of the system that are one unknown: those of each pocket of air (pocket.h).

#include "sim-server/fluid/params/parts.h"
#include "sim-server/fluid/pressure/grid_projected/multigrid.h"
#include "sim-server/fluid/pressure/grid_projected/pocket.h"

// Gives each cell of a pocket the mean of all its cells. With one work-item alone: the barriers
// that many need keep PoCL's compiler for minutes.
static void pool(global const AirPockets* all, global const int* list, global float* field) {
#if TEAM == 1
  for (int k = 0; HAS_POCKETS && k < all->count; ++k) {
    const AirPocket pocket = all->pocket[k];
    float sum = 0.0f;
    for (int i = 0; i < pocket.cells; ++i) sum += field[list[pocket.first + i]];
    for (int i = 0; i < pocket.cells; ++i) field[list[pocket.first + i]] = sum / pocket.cells;
  }
#endif
}
