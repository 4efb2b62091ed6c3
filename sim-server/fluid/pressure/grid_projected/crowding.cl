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

// The system's right side becomes the rate [1/s] at which cells should grow in this step, by how
// full they are. `seen`: what their hats see of open space; `open`: the diagonals. The solution
// begins at zero.
kernel void ask_for_room(constant MacGrid* g, float dt, global const float* seen,
                         global const float* fill, global const float* wet,
                         global const float* open, global float* x, global float* right,
                         global float* rest, global float* start, global float* way) {
  const Cells at = cells_of(g, get_global_id(0));
  const MacLevel l = g->level[0];
  if (at.z > l.nz) return;
  const int c = at.first;
  const lanes none = 0.0f;
  lane_flags counts = at.inside & (LOAD(wet, c) > none) & (LOAD(open, c) > none);
  if (HAS_SOLIDS) counts &= LOAD(seen, c) >= (lanes)(1.0f);
  const lanes off = select(none, LOAD(fill, c) - 1.0f, counts);
  const lane_flags lacks = off < none;
  lanes excess = off;
  if (any_lane(lacks)) excess = select(off, select(none, off, are_inner(l, fill, &at)), lacks);
  const lanes beyond = within(fabs(excess) - UNEVEN, 0.0f, MOST_EXCESS);
  STORE(copysign(beyond, excess) / dt, right, c);
  STORE(none, x, c);
  STORE(none, rest, c);
  STORE(none, start, c);
  STORE(none, way, c);
}

// The velocity of that displacement on faces: - grad f, 0 where solids and walls close them.
kernel void find_shift(constant MacGrid* g, global const float* gap, global const float* fill,
                       global const float* wet, global const float* air,
                       global const float* found, global float* shift) {
  const Cells at = cells_of(g, get_global_id(0));
  const MacLevel l = g->level[0];
  if (at.z > l.nz) return;
  const int step[3] = {1, l.row, l.layer};
  const float inverse[3] = {g->ix, g->iy, g->iz};
  const lanes none = 0.0f;
  for (int axis = 0; axis < 3; ++axis) {
    const int face = axis * l.cells + at.first;
    const lane_flags closed = are_walls(l, &at, axis) | (open_of(gap, face) <= none);
    const lanes rise = growth(fill, wet, air, found, at.first, step[axis]);
    STORE(select(-inverse[axis] * rise, none, closed | !at.real), shift, face);
  }
}
