// SPDX-License-Identifier: MIT
// The particles one work-item answers for: LANES of them, next to each other in the sorted arrays,
// one to a lane. They are taken row of cells by row of cells (a group that straddles the end of a
// row takes a turn for each), so that they lie close together and share one search of their
// neighbours.

typedef struct {
  lanes x, y, z;     // [m]
  lane_flags mine;   // lanes whose turn it is
  int next;          // first particle after this turn
  int row;           // of cells; the turn's particles are in
  int from, to;      // slices of the row
  float3 lower, upper;  // the box around the turn's particles [m]
} Group;

// Which group a work-item handles; past the last one for padding. Awake groups often lie together,
// and drivers hand work-items out in long runs: so packets of four groups are dealt from
// SPLASH_STRIPS strips in turn. Within a strip they follow each other, as caches like it.
static int group_of(constant FluidParams* p, int work_item) {
#if LANES > 1
  const int packets = ((p->count + LANES - 1) / LANES + 3) / 4;
  const int strip = (packets + SPLASH_STRIPS - 1) / SPLASH_STRIPS;
  const int turn = work_item / 4;
  const int packet = turn % SPLASH_STRIPS * strip + turn / SPLASH_STRIPS;
  if (turn >= SPLASH_STRIPS * strip || packet >= packets) return 4 * packets;
  return 4 * packet + work_item % 4;
#else
  return work_item;
#endif
}

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
