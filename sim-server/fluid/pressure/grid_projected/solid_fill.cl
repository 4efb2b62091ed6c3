// SPDX-License-Identifier: MIT
// How full cells are beside solids, whose hats see only a part of the space around them.

#include "sim-server/fluid/boundary/bodies.h"
#include "sim-server/fluid/boundary/body_face.h"
#include "sim-server/fluid/lanes/lanes.h"
#include "sim-server/fluid/neighbours/grid.h"
#include "sim-server/fluid/params/fluid_params.h"
#include "sim-server/fluid/pressure/grid_projected/mac_cell.h"
#include "sim-server/fluid/pressure/grid_projected/mac_grid.h"
#include "sim-server/fluid/pressure/grid_projected/solids.h"
#include "sim-server/fluid/pressure/grid_projected/surface.h"

#define OWN_WEIGHT 0.05f  // of a cell's own fill in the estimate of what its hat cannot see [1]
#define TOUCHES 0.75f     // bodies so near to a particle touch it, at rest half of one [spacings]
#define CLEAR 1.0f        // bodies that are farther off do not [spacings]

// Least distance between a body and the particles in a cell and in the cells around it, clamped to
// TOUCHES and CLEAR [spacings].
static float way_to_bodies(constant FluidParams* p, constant MacGrid* g, const Solids* s, int4 at,
                           global const int* cell_start, global const float* position) {
  const int n = p->capacity;
  const float3 edge = (float3)(g->hx, g->hy, g->hz);
  const float3 lower = (float3)(g->x, g->y, g->z) + edge * (float3)(at.x - 1, at.y - 1, at.z - 1);
  const float3 upper = lower + 3.0f * edge;
  const RowBox box = rows_of_box(p, lower, upper);
  float way = CLEAR;
  for (int z = box.high_z; z >= box.low_z && way > TOUCHES; --z) {
    for (int y = box.low_y; y <= box.high_y && way > TOUCHES; ++y) {
      const int2 run = run_of_row(p, cell_start, box, y, z);
      for (int j = run.x; j < run.y && way > TOUCHES; j += LANES) {
        const lanes px = load_x(position, j, run.y);
        const lanes py = LOAD(position + n, j), pz = LOAD(position + 2 * n, j);
        const lane_flags near = (px > (lanes)(lower.x)) & (px < (lanes)(upper.x)) &
                                (py > (lanes)(lower.y)) & (py < (lanes)(upper.y)) &
                                (pz > (lanes)(lower.z)) & (pz < (lanes)(upper.z));
        if (!any_lane(near)) continue;
        const BodyFace face = nearest_face_near(s->shapes, s->meshes, s->bodies, s->first,
                                                s->count, lower, upper, px, py, pz);
        way = fmin(way, least(select((lanes)(CLEAR), face.distance / p->spacing, near)));
      }
    }
  }
  return fmax(way, TOUCHES);
}

// `clear`, for cells of whose hat a body hides a part: 1 if no particle near the cell touches a
// body, 0 if one does, in between by its distance. Where it is 1, the hidden part counts as empty.
kernel void find_clear(constant FluidParams* p, constant MacGrid* g, constant BodyShape* shapes,
                       global const float* meshes, global const BodyStep* bodies, int first_body,
                       int body_count, global const int* cell_start, global const float* position,
                       global const float* seen, global const int* owner, global float* clear) {
  const Cells at = cells_of(g, get_global_id(0));
  const MacLevel l = g->level[0];
  if (at.z > l.nz) return;
  const lanes none = 0.0f, one = 1.0f;
  const lane_flags cut = at.inside & (LOAD(owner, at.first) >= (lane_flags)(0)) &
                         (LOAD(seen, at.first) < one);
  STORE(none, clear, at.first);
  if (!any_lane(cut)) return;
  const Solids solids = {shapes, meshes, bodies, first_body, body_count, 0.0f};
  int x[LANES], y[LANES], is_cut[LANES];
  STORE(at.x, x, 0);
  STORE(at.y, y, 0);
  STORE(cut, is_cut, 0);
  for (int lane = 0; lane < LANES; ++lane) {
    if (!is_cut[lane]) continue;
    const float way = way_to_bodies(p, g, &solids, (int4)(x[lane], y[lane], at.z, 1), cell_start,
                                    position);
    clear[at.first + lane] = (way - TOUCHES) / (CLEAR - TOUCHES);
  }
}

// How full cells are of what their hats see of open space.
static lanes full_part(global const float* fill, global const float* seen, int c) {
  return LOAD(fill, c) / fmax(LOAD(seen, c), (lanes)(LEAST_SEEN));
}

// How far the fill of cells says where the surface is, by how much open space they see [1].
static lanes seen_well(global const float* seen, int c) {
  return within(5.0f * LOAD(seen, c) - 4.0f, 0.0f, 1.0f);
}

// How full cells are beside solids: as if what solids take of their hats were as full as the water
// around goes on to be there, but empty where no water touches a body. The less open space a cell
// has, the more it counts what is behind its open faces: in a gap where no particle fits there may
// be water.
kernel void fill_beside_solids(constant MacGrid* g, global const float* volume,
                               global const float* room, global const float* seen,
                               global const float* clear, global const float* fill,
                               global float* filled) {
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
  STORE(select(none, estimate, known), filled, c);
}
