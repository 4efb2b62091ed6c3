// SPDX-License-Identifier: MIT
// Once a frame: how many frames more each cell stays awake, and what that means for the cells
// around it. One team for each row of cells, whose items take every so-manieth cell; on CPUs a team
// is one alone.

typedef struct {
  int row, item, items;
} RowShare;

static RowShare row_share(void) {
#if TEAM > 1
  const RowShare share = {get_group_id(0), get_local_id(0), get_local_size(0)};
#else
  const RowShare share = {get_global_id(0), 0, 1};
#endif
  return share;
}

// Until all of the team have written what they have to.
static void wait_for_team(void) {
#if TEAM > 1
  barrier(CLK_GLOBAL_MEM_FENCE);
#endif
}

#include "sim-server/fluid/lanes/lanes.h"
#include "sim-server/fluid/neighbours/grid.h"
#include "sim-server/fluid/params/fluid_params.h"
#include "sim-server/fluid/sleep/sleep.h"

// Cells that lie in [lower, upper] along one axis, whatever part of them.
static int2 cells_within(float lower, float upper, float origin, float inverse_cell, int cells) {
  return (int2)((int)fmax((lower - origin) * inverse_cell, 0.0f),
                (int)fmin((upper - origin) * inverse_cell, (float)(cells - 1)));
}

// Whether any of the particles `first` to `last` is not slower than `speed`.
static bool any_fast(int n, global const float* velocity, float speed, int first, int last) {
  for (int j = first; j < last; j += LANES) {
    // Not the other way round: what is no number stays awake.
    const lane_flags slow = squares_at(velocity, n, j) <= (lanes)(speed * speed);
    if (any_lane((slow == 0) & (LANE_NUMBERS < (lane_flags)(last - j)))) return true;
  }
  return false;
}

// Behind what goes on in all cells: what would, were their own row all that is awake.
static global int* own_activity(constant FluidParams* p, global int* activity) {
  return activity + p->cells_x * p->cells_y * p->cells_z;
}

// What awake cells of a row mean for cell `x` of it.
static int activity_along(constant FluidParams* p, global const int* awake, int x) {
  const int last = min(x + WAKES_DENSITY, p->cells_x - 1);
  int activity = 0;
  for (int k = max(x - WAKES_DENSITY, 0); k <= last; ++k) {
    if (awake[k] == 0) continue;
    const bool moves = abs(k - x) <= WAKES_MOTION;
    activity = max(activity, moves ? SPLASH_ACTIVITY_MOTION : SPLASH_ACTIVITY_DENSITY);
  }
  return activity;
}

// `bodies`: those of all steps of the frame; `piston_reach`: cells at the moving wall's side that
// it wakes; `speed`: slower water may sleep [m/s]; `hold`: frames.
kernel void keep_awake(constant FluidParams* p, global const int* cell_start,
                       global const float* velocity, global const BodyStep* bodies, int body_count,
                       int piston_reach, float speed, int hold, global int* awake,
                       global int* activity) {
  const RowShare share = row_share();
  const int row = share.row;
  if (row >= p->cells_y * p->cells_z) return;
  const int n = p->capacity;
  global int* most = awake + p->cells_x * p->cells_y * p->cells_z + row;
  awake += row * p->cells_x;
  cell_start += row * p->cells_x * SLICES;
  for (int x = share.item; x < p->cells_x; x += share.items) {
    const int first = cell_start[x * SLICES], last = cell_start[(x + 1) * SLICES];
    const int frames = any_fast(n, velocity, speed, first, last) ? hold : max(awake[x] - 1, 0);
    awake[x] = x < piston_reach ? hold : frames;
  }
  const int y = row % p->cells_y, z = row / p->cells_y;
  for (int b = 0; b < body_count; ++b) {
    const BodyStep body = bodies[b];
    const int2 ys =
        cells_within(body.lower_y, body.upper_y, p->origin_y, p->inverse_cell, p->cells_y);
    const int2 zs =
        cells_within(body.lower_z, body.upper_z, p->origin_z, p->inverse_cell, p->cells_z);
    if (y < ys.x || y > ys.y || z < zs.x || z > zs.y || body.speed <= SPLASH_TREMBLE) {
      continue;
    }
    const int2 xs =
        cells_within(body.lower_x, body.upper_x, p->origin_x, p->inverse_cell, p->cells_x);
    // Of these its own: the first whose number leaves what its item's does.
    const int own = xs.x + (share.item + share.items - xs.x % share.items) % share.items;
    for (int x = own; x <= xs.y; x += share.items) awake[x] = hold;
  }
  int mine = 0;
  for (int x = share.item; x < p->cells_x; x += share.items) mine = max(mine, awake[x]);
  if (share.item == 0) *most = 0;
  wait_for_team();
  if (mine > 0) atomic_max(most, mine);
  global int* along = own_activity(p, activity) + row * p->cells_x;
  for (int x = share.item; x < p->cells_x; x += share.items) along[x] = activity_along(p, awake, x);
}

kernel void spread_activity(constant FluidParams* p, global const int* awake,
                            global int* activity) {
  const RowShare share = row_share();
  const int row = share.row;
  if (row >= p->cells_y * p->cells_z) return;
  global const int* most = awake + p->cells_x * p->cells_y * p->cells_z;
  global const int* own = own_activity(p, activity);
  activity += row * p->cells_x;
  for (int x = share.item; x < p->cells_x; x += share.items) activity[x] = 0;
  const int at_y = row % p->cells_y, at_z = row / p->cells_y;
  const int last_y = min(at_y + WAKES_DENSITY, p->cells_y - 1);
  const int last_z = min(at_z + WAKES_DENSITY, p->cells_z - 1);
  for (int z = max(at_z - WAKES_DENSITY, 0); z <= last_z; ++z) {
    for (int y = max(at_y - WAKES_DENSITY, 0); y <= last_y; ++y) {
      const int other = z * p->cells_y + y;
      if (most[other] == 0) continue;
      const int off = max(abs(z - at_z), abs(y - at_y));
      const int reach = off <= WAKES_MOTION ? SPLASH_ACTIVITY_MOTION : SPLASH_ACTIVITY_DENSITY;
      for (int x = share.item; x < p->cells_x; x += share.items) {
        activity[x] = max(activity[x], min(own[other * p->cells_x + x], reach));
      }
    }
  }
}
