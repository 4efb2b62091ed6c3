// SPDX-License-Identifier: MIT
// Water at rest sleeps. A cell is awake while anything in it is fast, and for some frames after
// that; a body or a wall that moves wakes what it reaches. Particles within one cell of an awake
// one move, within two their density is kept up, so that whatever moves finds its neighbours'
// pressures right. All others stay as they are: still neighbours, like a wall.
// `awake` holds a number for each cell and, behind them, one for each row of cells: the largest of
// the row, which saves most groups the look at its cells.

#define WAKES_MOTION 1   // [cells]
#define WAKES_DENSITY 2

// Whether a cell within `reach` cells of the group's is awake.
static bool awake_near(constant FluidParams* p, global const int* awake, const Group* g,
                       int reach) {
  const int at_y = g->row % p->cells_y, at_z = g->row / p->cells_y;
  for (int z = max(at_z - reach, 0); z <= min(at_z + reach, p->cells_z - 1); ++z) {
    for (int y = max(at_y - reach, 0); y <= min(at_y + reach, p->cells_y - 1); ++y) {
      const int at = z * p->cells_y + y;
      if (awake[p->cells_x * p->cells_y * p->cells_z + at] == 0) continue;
      global const int* row = awake + at * p->cells_x;
      const int last = min(g->to / SLICES + reach, p->cells_x - 1);
      for (int x = max(g->from / SLICES - reach, 0); x <= last; ++x) {
        if (row[x] > 0) return true;
      }
    }
  }
  return false;
}
