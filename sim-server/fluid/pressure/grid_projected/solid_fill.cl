// SPDX-License-Identifier: MIT
// How full cells are beside solids, whose hats see only a part of the space around them.

#include "sim-server/fluid/lanes/lanes.h"
#include "sim-server/fluid/params/fluid_params.h"
#include "sim-server/fluid/pressure/grid_projected/mac_cell.h"
#include "sim-server/fluid/pressure/grid_projected/mac_grid.h"
#include "sim-server/fluid/pressure/grid_projected/solids.h"
#include "sim-server/fluid/pressure/grid_projected/surface.h"

#define SEES_ENOUGH 0.9f  // of the space around it, for a cell to say how full others are [1]
#define MAY_BE_EMPTY 0.15f  // cells estimated less full may hold air, whatever is around them [1]
#define WITHOUT_AIR 0.55f   // least fill of cells that cannot hold air: they count as water [1]
#define OWN_WEIGHT 0.05f  // of a cell's own fill in the estimate of what its hat cannot see [1]

// How full cells are of what their hats see of open space.
static lanes full_part(global const float* fill, global const float* seen, int c) {
  return LOAD(fill, c) / fmax(LOAD(seen, c), (lanes)(LEAST_SEEN));
}

// How far the fill of cells says where the surface is, by how much open space they see [1].
static lanes seen_well(global const float* seen, int c) {
  return within(5.0f * LOAD(seen, c) - 4.0f, 0.0f, 1.0f);
}

// The film between a body and the floor or a wall is as full as the cells around the body, on
// average over the nearest ones along x and y that see enough. `otherwise`: if there are none.
static float full_film(const MacLevel l, int4 at, global const float* fill,
                       global const float* seen, float otherwise) {
  float sum = 0.0f, found = 0.0f;
  for (int way = 0; way < 4; ++way) {
    const int4 step = (way & 1 ? 1 : -1) * (int4)(way < 2, way >= 2, 0, 0);
    for (int4 next = at + step;
         next.x >= 0 && next.x < l.nx && next.y >= 0 && next.y < l.ny; next += step) {
      const int c = number_of(l, next);
      if (seen[c] < SEES_ENOUGH) continue;
      sum += fmin(fill[c] / seen[c], 1.0f);
      found += 1.0f;
      break;
    }
  }
  return found > 0.0f ? sum / found : otherwise;
}

// Raises the estimated fill of cells that cannot hold air, because neither they nor any cell around
// them held air in the step before. Behind a body that moves in deep water the particles lag; cells
// there would otherwise count as air and lose the pressure of the water around. `airless`: 1 where
// a cell held no air in the step before, else 0.
static lanes without_new_air(const MacLevel l, const Cells* at, global const float* airless,
                             lanes fill) {
  const lane_flags low =
      at->inside & (fill > (lanes)(MAY_BE_EMPTY)) & (fill < (lanes)(WITHOUT_AIR));
  if (!any_lane(low)) return fill;
  const lane_flags no_air_near = least_around(l, airless, at) > (lanes)(0.0f);
  return select(fill, (lanes)(WITHOUT_AIR), low & no_air_near);
}

// How full cells are beside solids: as if what solids take of their hats were as full as the water
// around goes on to be there, but empty where no water touches a body. The less open space a cell
// has, the more it counts what is behind its open faces: in a gap where no particle fits there may
// be water.
kernel void fill_beside_solids(constant MacGrid* g, global const float* volume,
                               global const float* room, global const float* seen,
                               global const float* clear, global const float* airless,
                               global const float* fill, global float* filled) {
  const Cells at = cells_of(g, get_global_id(0));
  const MacLevel l = g->level[0];
  if (at.z > l.nz) return;
  const int c = at.first;
  const int step[3] = {1, l.row, l.layer};
  const lane_flags here[3] = {at.x, at.y, at.z};
  const int count[3] = {l.nx, l.ny, l.nz};
  const lanes none = 0.0f, one = 1.0f, own = LOAD(room, c), hidden = one - LOAD(seen, c);
  lanes weights = OWN_WEIGHT, estimates = OWN_WEIGHT * full_part(fill, seen, c);
  lanes in_gaps = 0.0f, gaps = 0.0f;
  if (any_lane(at.real & (hidden > none))) {
    const lanes closed = (one - own) * (one - own);
    for (int axis = 0; axis < 3; ++axis) {
      for (int side = 0; side < 2; ++side) {
        const int s = (2 * side - 1) * step[axis];
        const lane_flags there = here[axis] + (2 * side - 1);
        const lane_flags beside =
            at.real & (there >= (lane_flags)(0)) & (there < (lane_flags)(count[axis]));
        if (!any_lane(beside)) continue;
        const lanes near = full_part(fill, seen, c + s), far = full_part(fill, seen, c + 2 * s);
        const lanes trust =
            select(none, seen_well(seen, c + s) * seen_well(seen, c + 2 * s), beside);
        const lanes expected = near + trust * (fill_beyond(near, far) - near);
        weights += trust;
        estimates += trust * expected;
        const lanes open = LOAD(volume, axis * l.cells + c + side * step[axis]);
        const lanes through = LOAD(room, c + s) * open;
        const lanes share = select(none, closed * through * LOAD(seen, c + s), beside);
        in_gaps += share * expected;
        gaps += share;
      }
    }
  }
  const lanes whole = LOAD(fill, c) + hidden * estimates / weights, sure = own * LOAD(seen, c);
  const lanes space = sure + gaps;
  const lane_flags known = at.real & (space > (lanes)(LEAST_SEEN));
  const lanes touched = (sure * whole + in_gaps) / space;
  const lanes estimate = touched + LOAD(clear, c) * (LOAD(fill, c) - touched);
  STORE(without_new_air(l, &at, airless, select(none, estimate, known)), filled, c);
  const lane_flags at_wall = (at.x == (lane_flags)(0)) | (at.x == (lane_flags)(l.nx - 1)) |
                             (at.y == (lane_flags)(0)) | (at.y == (lane_flags)(l.ny - 1)) |
                             ((lane_flags)(at.z) == (lane_flags)(0));
  const lane_flags films = at.inside & at_wall & (own > none) & (own < (lanes)(2.0f * FILM));
  if (!any_lane(films)) return;
  int x[LANES], y[LANES], is_film[LANES];
  STORE(at.x, x, 0);
  STORE(at.y, y, 0);
  STORE(films, is_film, 0);
  for (int lane = 0; lane < LANES; ++lane) {
    if (!is_film[lane]) continue;
    const int4 cell = (int4)(x[lane], y[lane], at.z, 0);
    filled[c + lane] = full_film(l, cell, fill, seen, filled[c + lane]);
  }
}
