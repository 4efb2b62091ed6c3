// SPDX-License-Identifier: MIT
// Faces beside water get what the pressures do to them, and walls beside it stop it, as far as a
// cell along the wall: what the step changed at each face is left in `pushed`, or MAC_UNKNOWN where
// there is no water, or a solid closes the face.
// Then the pressures of cells with water are kept, in Pa.

#include "sim-server/fluid/params/fluid_params.h"
#include "sim-server/fluid/pressure/grid_projected/mac_cell.h"
#include "sim-server/fluid/pressure/grid_projected/mac_grid.h"
#include "sim-server/fluid/pressure/grid_projected/room.h"
#include "sim-server/fluid/pressure/grid_projected/surface.h"

// How fast f grows across the lower faces of cells, `s` from those below [edges].
static lanes growth(global const float* fill, global const float* wet, global const float* found,
                    int c, int s) {
  const lanes none = 0.0f;
  const lane_flags here = LOAD(wet, c) > none, there = LOAD(wet, c - s) > none;
  const lanes f = LOAD(found, c), below = LOAD(found, c - s);
  const lanes full = LOAD(fill, c), full_below = LOAD(fill, c - s);
  const lanes rise = f / way_to_surface(full, full_below);
  const lanes fall = -below / way_to_surface(full_below, full);
  return select(select(fall, rise, here), f - below, here & there);
}

// Whether water is next to the cells beside a wall, along the wall; `axis`: across it. Such a wall
// stops what has risen above the surface there, as it stops the water below.
static lane_flags are_washed(const MacLevel l, global const float* wet, const Cells* at, int axis) {
  const int step[3] = {1, l.row, l.layer};
  const lanes none = 0.0f;
  lanes sum = 0.0f;
  for (int along = 0; along < 3; ++along) {
    if (along == axis) continue;
    for (int side = -1; side < 2; side += 2) {
      const bool ends = along == 2 && at->z + side < 0;
      const int c = at->first + (ends ? 0 : side * step[along]);
      sum += LOAD(wet, c);
      if (axis < 2) sum += LOAD(wet, c - step[axis]);  // nothing is below the floor
    }
  }
  return sum > none;
}

kernel void project_faces(constant FluidParams* p, constant MacGrid* g, float dt,
                          global const float* gap, global const float* fill,
                          global const float* mean, global const float* weight,
                          global const float* found, global const float* wet, global float* pushed,
                          global float* pressure) {
  const Cells at = cells_of(g, get_global_id(0));
  const MacLevel l = g->level[0];
  if (at.z > l.nz) return;
  const int c = at.first;
  const int step[3] = {1, l.row, l.layer};
  const float inverse[3] = {g->ix, g->iy, g->iz};
  const lanes none = 0.0f;
  for (int axis = 0; axis < 3; ++axis) {
    const int face = axis * l.cells + c;
    const lane_flags wall = are_walls(l, &at, axis);
    lane_flags beside = LOAD(wet, c) + LOAD(wet, c - step[axis]) > none;
    if (at.z < l.nz && any_lane(wall)) beside |= wall & are_washed(l, wet, &at, axis);
    const lane_flags open = (open_of(gap, face) > none) & beside;
    const lanes by = inverse[axis] * growth(fill, wet, found, c, step[axis]);
    const lanes change = LOAD(pushed, face) - LOAD(mean, face) - select(by, none, wall);
    const lane_flags known = at.real & open & (LOAD(weight, face) > (lanes)(MAC_LIGHT));
    STORE(select((lanes)(MAC_UNKNOWN), change, known), pushed, face);
  }
  const float density = p->rest_density / dt;
  STORE(select(none, LOAD(wet, c) * LOAD(found, c) * density, at.real), pressure, c);
}
