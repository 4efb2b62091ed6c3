// SPDX-License-Identifier: MIT
// The particles one work-item answers for: LANES of them, next to each other in the sorted arrays,
// one to a lane. They are taken row of cells by row of cells (a group that straddles the end of a
// row takes a turn for each), so that they lie close together and share one search of their
// neighbours.

#include "sim-server/fluid/lanes/lanes.h"
#include "sim-server/fluid/neighbours/grid.h"
#include "sim-server/fluid/params/fluid_params.h"

typedef struct {
  lanes x, y, z;     // [m]
  lane_flags mine;   // lanes whose turn it is
  int next;          // first particle after this turn
  int row;           // of cells; the turn's particles are in
  int from, to;      // slices of the row
  float3 lower, upper;  // the box around the turn's particles [m]
} Group;

// The particles of the work-item's `first` to `last` (not included), from `turn` on.
static Group load_group(constant FluidParams* p, global const int* cell_start,
                        global const float* position, int first, int last, int turn) {
  const int n = p->capacity;
  Group g;
  g.x = LOAD(position, first);
  g.y = LOAD(position + n, first);
  g.z = LOAD(position + 2 * n, first);
  g.row = cell_row(p, position[n + turn], position[2 * n + turn]);
  g.next = max(turn + 1, min(last, cell_start[(g.row + 1) * p->cells_x * SLICES]));
  g.from = slice_x(p, position[turn]);
  g.to = slice_x(p, position[g.next - 1]);
#if LANES > 1
  g.mine = (LANE_NUMBERS >= (lane_flags)(turn - first)) &
           (LANE_NUMBERS < (lane_flags)(g.next - first));
#else
  g.mine = 1;
#endif
  const lanes far = FAR_AWAY;
  g.lower = (float3)(least(select(far, g.x, g.mine)), least(select(far, g.y, g.mine)),
                     least(select(far, g.z, g.mine)));
  g.upper = (float3)(most(select(-far, g.x, g.mine)), most(select(-far, g.y, g.mine)),
                     most(select(-far, g.z, g.mine)));
  return g;
}
