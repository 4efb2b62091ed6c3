// SPDX-License-Identifier: MIT
// Faces beside water get what the pressures do to them, and walls beside it stop it, as far as a
// cell along the wall: what the step changed at each face is left in `pushed`, or MAC_UNKNOWN where
// there is no water, or a solid closes the face.
// Then the pressures of cells with water, or with air that is shut in, are kept, in Pa.

#include "sim-server/fluid/params/fluid_params.h"
#include "sim-server/fluid/pressure/grid_projected/mac_cell.h"
#include "sim-server/fluid/pressure/grid_projected/mac_grid.h"
#include "sim-server/fluid/pressure/grid_projected/room.h"
#include "sim-server/fluid/pressure/grid_projected/sharpen.h"
#include "sim-server/fluid/pressure/grid_projected/surface.h"

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
                          global const BodyStep* bodies, int first_body, float piston_speed,
                          global const float* gap, global const float* held,
                          global const int* owner, global const float* fill,
                          global const float* carries, global const float* weight,
                          global const float* found, global const float* wet,
                          global const float* air, global float* pushed,
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
    lane_flags open = (open_of(gap, face) > none) & beside;
    const lanes by = inverse[axis] * growth(fill, wet, air, found, c, step[axis]);
    lanes change = LOAD(pushed, face) - LOAD(carries, face) - select(by, none, wall);
    if (HAS_SOLIDS) {
      const lanes part = LOAD(held, face);
      const lane_flags some = at.real & (part > none);
      if (any_lane(some)) {
        open |= some & beside;
        const lanes goes = solids_at_faces(g, bodies + first_body, owner, dt, piston_speed, &at,
                                           some, axis, 0, step[axis]);
        const lanes gained = select(change, goes - LOAD(carries, face), some);
        change += part * (gained - change);
      }
    }
    const lane_flags known = at.real & open & (LOAD(weight, face) > (lanes)(MAC_LIGHT));
    STORE(select((lanes)(MAC_UNKNOWN), change, known), pushed, face);
  }
  const float density = p->rest_density / dt;
  const lane_flags presses = (LOAD(wet, c) > none) | are_shut_in(air, c);
  STORE(select(none, LOAD(found, c) * density, at.real & presses), pressure, c);
}

// The pressure at a face at the surface moves water of t rho0 V (system.cl), but the particles
// around the face may have more mass, m: under a flat surface what the next face in the water lacks
// of its own. So what they get is the mean of both faces' changes, (t du + (m - t) du') / m with m
// in rho0 V, which adds up to the pressures' momentum. Of a `field` on faces, known where `change`
// is.
kernel void share_at_surface(constant MacGrid* g, global const float* gap, global const float* fill,
                             global const float* weight, global const float* wet,
                             global const float* change, global float* field) {
  const Cells at = cells_of(g, get_global_id(0));
  const MacLevel l = g->level[0];
  if (at.z > l.nz) return;
  const int step[3] = {1, l.row, l.layer};
  const lanes none = 0.0f;
  for (int axis = 0; axis < 3; ++axis) {
    const int s = step[axis], first = axis * l.cells + at.first;
    lane_flags ends = at.real & ((LOAD(wet, at.first) > none) ^ (LOAD(wet, at.first - s) > none)) &
                      (are_walls(l, &at, axis) == (lane_flags)(0)) &
                      (LOAD(change, first) < (lanes)(MAC_KNOWN));
    if (HAS_SOLIDS) ends &= LOAD(gap, first) >= (lanes)(1.0f);
    if (!any_lane(ends)) continue;
    int is_end[LANES];
    STORE(ends, is_end, 0);
    for (int lane = 0; lane < LANES; ++lane) {
      if (!is_end[lane]) continue;
      const int c = at.first + lane, face = first + lane;
      const bool here = wet[c] > 0.0f;
      const int water = here ? c : c - s, air = here ? c - s : c, next = here ? face + s : face - s;
      if (wet[2 * water - air] == 0.0f || change[next] >= MAC_KNOWN) continue;
      const float way = way_to_surface_of(fill[water], fill[air]);
      const float mass = fmax(g->share * weight[face], way);
      field[face] = field[next] + way / mass * (field[face] - field[next]);
    }
  }
}

// `sharp`: a `field` on faces, sharpened where it is known and in the water; `parted`: by `parts`.
kernel void sharpen_faces(constant MacGrid* g, global const int* owner, global const float* fill,
                          global const float* weight, int parted, global const float* parts,
                          global const float* field, global float* sharp) {
  const Cells at = cells_of(g, get_global_id(0));
  const MacLevel l = g->level[0];
  if (at.z > l.nz) return;
  for (int axis = 0; axis < 3; ++axis) {
    const int face = axis * l.cells + at.first;
    STORE(sharpened(g, &at, owner, fill, weight, parted ? parts : 0, field, axis), sharp, face);
  }
}
