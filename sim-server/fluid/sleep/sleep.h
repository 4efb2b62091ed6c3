// SPDX-License-Identifier: MIT
// Water at rest sleeps. A cell is awake while anything in it is fast, and for some frames after
// that; a body or a wall that moves wakes what it reaches. Particles within one cell of an awake
// one move, within two their density is kept up, so that whatever moves finds its neighbours'
// pressures right. All others stay as they are: still neighbours, like a wall.
// `awake` holds a number for each cell and, behind them, one for each row of cells: the largest of
// the row, by which rows that sleep are passed over. `activity` says of each cell what follows.

#include "sim-server/fluid/lanes/lanes.h"
#include "sim-server/fluid/neighbours/grid.h"
#include "sim-server/fluid/neighbours/group.h"
#include "sim-server/fluid/params/fluid_params.h"

#define WAKES_MOTION 1  // [cells]
#define WAKES_DENSITY 2

// The most that goes on in cells `from` to `to` of a row.
static int activity_in(constant FluidParams* p, global const int* activity, int row, int from,
                       int to) {
  int most = 0;
  for (int x = from; x <= to; ++x) most = max(most, activity[row * p->cells_x + x]);
  return most;
}

static int activity_of(constant FluidParams* p, global const int* activity, const Group* g) {
  return activity_in(p, activity, g->row, g->from / SLICES, g->to / SLICES);
}

// What sleeping particles `first` to `last` had, before the sort.
static lanes kept(global const float* before, global const int* source, int first, int last) {
  float part[LANES];
  for (int lane = 0; lane < LANES; ++lane) {
    part[lane] = before[source[min(first + lane, last - 1)]];
  }
  return LOAD(part, 0);
}
