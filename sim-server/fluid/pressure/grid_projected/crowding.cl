// SPDX-License-Identifier: MIT
// Where particles have come too close together, or too far apart within the water, they are moved
// until each cell again holds its volume of water (implicit density projection, Kugelstadt et al.
// 2019): by the system of the pressures, with what a cell holds too much as its right side, so that
// nothing moves into a wall or a solid and the surface gives way. The sums over neighbours
// (spacing.cl) even out what is smaller than a cell. It is a displacement: no velocity changes.
// What a cell holds too much is what its hat sees of particles beyond its volume. Where a solid is
// in the hat, that is not known well enough: in still water it is off by up to a tenth, and at the
// edge of water on a slope particles would be driven together. There nothing is asked for.

#include "sim-server/fluid/params/fluid_params.h"
#include "sim-server/fluid/pressure/grid_projected/mac_cell.h"
#include "sim-server/fluid/pressure/grid_projected/mac_grid.h"
#include "sim-server/fluid/pressure/grid_projected/room.h"
#include "sim-server/fluid/pressure/grid_projected/surface.h"

#define UNEVEN 0.05f      // an excess or lack below this moves nothing [1]
#define MOST_EXCESS 0.5f  // beyond that, of a cell's excess or lack, that counts [1]

// Whether all cells around one, but for those behind walls, hold water.
static bool is_inner(const MacLevel l, global const float* fill, int4 at) {
  for (int k = 0; k < 27; ++k) {
    const int4 there = at + (int4)(k % 3 - 1, k / 3 % 3 - 1, k / 9 - 1, 0);
    const bool behind =
        there.x < 0 || there.x >= l.nx || there.y < 0 || there.y >= l.ny || there.z < 0;
    if (!behind && !(fill[number_of(l, there)] > MAC_FULL)) return false;
  }
  return true;
}

// The system's right side becomes the rate [1/s] at which cells should grow in this step, by how
// full they are. `seen`: what their hats see of open space; `open`: the diagonals. The solution
// begins at zero.
kernel void ask_for_room(constant MacGrid* g, float dt, global const float* seen,
                         global const float* fill, global const float* wet,
                         global const float* open, global float* x, global float* right,
                         global float* rest, global float* start, global float* way) {
  const int4 at = cell_of(g, get_global_id(0));
  if (at.w == 0) return;
  const MacLevel l = g->level[0];
  const int c = number_of(l, at);
  const bool counts = wet[c] > 0.0f && open[c] > 0.0f && !(HAS_SOLIDS && seen[c] < 1.0f);
  float excess = counts ? fill[c] - 1.0f : 0.0f;
  if (excess < 0.0f && !is_inner(l, fill, at)) excess = 0.0f;
  const float beyond = fmax(fabs(excess) - UNEVEN, 0.0f);
  right[c] = copysign(fmin(beyond, MOST_EXCESS), excess) / dt;
  x[c] = rest[c] = start[c] = way[c] = 0.0f;
}

// The velocity of that displacement on faces: - grad f, 0 where solids and walls close them.
kernel void find_shift(constant MacGrid* g, global const float* gap, global const float* fill,
                       global const float* wet, global const float* found, global float* shift) {
  const int4 at = cell_of(g, get_global_id(0));
  if (at.w == 0) return;
  const MacLevel l = g->level[0];
  const int c = number_of(l, at);
  const int step[3] = {1, l.row, l.layer};
  const int here[3] = {at.x, at.y, at.z}, count[3] = {l.nx, l.ny, -1};
  const float inverse[3] = {g->ix, g->iy, g->iz};
  for (int axis = 0; axis < 3; ++axis) {
    const int below = c - step[axis], face = axis * l.cells + c;
    const bool wall = here[axis] == 0 || here[axis] == count[axis];
    const bool is_open = !wall && first_lane(open_of(gap, face)) > 0.0f;
    float rise = 0.0f;
    if (is_open && wet[c] > 0.0f && wet[below] > 0.0f) {
      rise = found[c] - found[below];
    } else if (is_open && wet[c] > 0.0f) {
      rise = found[c] / way_to_surface_of(fill[c], fill[below]);
    } else if (is_open && wet[below] > 0.0f) {
      rise = -found[below] / way_to_surface_of(fill[below], fill[c]);
    }
    shift[face] = -inverse[axis] * rise;
  }
}
