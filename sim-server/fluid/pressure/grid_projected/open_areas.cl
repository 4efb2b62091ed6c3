// SPDX-License-Identifier: MIT
// How open faces are for the flow beside solids: by the area that these leave open (Ng, Min & Gibou
// 2009), also where a plate is thinner than a cell.

#include "sim-server/fluid/boundary/bodies.h"
#include "sim-server/fluid/lanes/lanes.h"
#include "sim-server/fluid/params/fluid_params.h"
#include "sim-server/fluid/pressure/grid_projected/mac_cell.h"
#include "sim-server/fluid/pressure/grid_projected/mac_grid.h"
#include "sim-server/fluid/pressure/grid_projected/solids.h"
#include "sim-server/fluid/pressure/grid_projected/surface.h"

#define SECTIONS 4        // between two cells' middles, in which a thin plate is looked for
#define LESS_CLOSED 0.25f // a thin plate leaves faces open that are so much less closed [1]
#define THIN 1.0f         // bodies that are no thicker close faces by area [cells]
#define THICK 1.5f        // bodies that are as thick close them by volume [cells]

// How much solids leave open of the section across an axis, `part` of the way from the middle of
// the cell below the one at `at` to its own [1]. `sides`: as looked_at.
static float open_surface(constant FluidParams* p, constant MacGrid* g, const Solids* s, int4 at,
                          int axis, float part, bool sides) {
  const float edge[3] = {g->hx, g->hy, g->hz}, from[3] = {g->x, g->y, g->z};
  const int cell[3] = {at.x, at.y, at.z};
  const int across[2] = {(axis + 1) % 3, (axis + 2) % 3};
  float place[3][16], d[16];  // nine places, and the last one again for whole vectors
  for (int n = 0; n < 16; ++n) {
    const int k = min(n, 8);
    place[axis][n] = from[axis] + (cell[axis] - 0.5f + part) * edge[axis];
    place[across[0]][n] = from[across[0]] + (cell[across[0]] + 0.5f * (k % 3)) * edge[across[0]];
    place[across[1]][n] = from[across[1]] + (cell[across[1]] + 0.5f * (k / 3)) * edge[across[1]];
    const float3 there = looked_at(g, (float3)(place[0][n], place[1][n], place[2][n]), sides);
    place[0][n] = there.x;
    place[1][n] = there.y;
    place[2][n] = there.z;
  }
  const float3 first = (float3)(place[0][0], place[1][0], place[2][0]);
  const float3 last = (float3)(place[0][8], place[1][8], place[2][8]);
  for (int n = 0; n < 9; n += LANES) {
    lanes whose;
    const lanes far =
        solid_distance(p, s, first, last, LOAD(place[0], n), LOAD(place[1], n), LOAD(place[2], n),
                       &whose);
    STORE(far, d, n);
  }
  float sum = 0.0f;
  for (int k = 0; k < 4; ++k) {
    const int a = k % 2 + 3 * (k / 2);
    const float flat[8] = {d[a], d[a + 1], d[a + 3], d[a + 4], d[a], d[a + 1], d[a + 3], d[a + 4]};
    sum += 0.25f * open_box(flat);
  }
  return sum < LEAST_GAP ? 0.0f : sum;
}

// How much a body is a plate thinner than a cell at a face [1]: `volume` is what it leaves of the
// volume around the face, `below` and `above` of those around the next faces along the axis. A
// thicker body closes one of these much more, and a body's side along the axis both as much.
static float plate_share(float volume, float below, float above) {
  const float thin = clamp(1.0f - (volume - fmin(below, above)) / LESS_CLOSED, 0.0f, 1.0f);
  return thin * clamp((fmax(below, above) - volume) / (1.0f - volume), 0.0f, 1.0f);
}

// How thin a body is around a face [1], by how deep it is in the cells beside the face and in those
// around them: 1 up to THIN, 0 from THICK on.
static float thinness(const MacLevel l, int axis, int face_cell, global const float* depth) {
  const int step[3] = {1, l.row, l.layer};
  const int along = step[axis], a = step[(axis + 1) % 3], b = step[(axis + 2) % 3];
  float deepest = 0.0f;
  for (int k = 0; k < 36; ++k) {
    const int near = face_cell + (k / 9 - 2) * along + (k % 3 - 1) * a + (k / 3 % 3 - 1) * b;
    deepest = fmax(deepest, depth[clamp(near, 0, l.cells - 1)]);
  }
  return clamp((THICK - 2.0f * deepest) / (THICK - THIN), 0.0f, 1.0f);
}

// What a body leaves open of the area of a face between two full cells: `volume` is what it leaves
// of the volume around the face. A plate thinner than a cell, by its `share`, may be between two
// faces, which are then more open than their volumes. The one whose volume it closes more is as
// open as its widest section leaves it; the nearer the other one comes to that, the more so is it.
// `held`: of what is open around the face, the part that such a plate closes.
static float open_area(constant FluidParams* p, constant MacGrid* g, const Solids* s, int4 at,
                       int axis, float volume, float share, bool sides, float* held) {
  const float here = open_surface(p, g, s, at, axis, 0.5f, sides);
  const bool between = here > volume && share > 0.0f;
  float least = here;
  for (int k = 0; k < SECTIONS && between; ++k) {
    least = fmin(least, open_surface(p, g, s, at, axis, (k + 0.5f) / SECTIONS, sides));
  }
  const float open = here + share * (least - here);
  *held = open < LEAST_GAP ? 1.0f : 1.0f - open / here;
  return open < LEAST_GAP ? 0.0f : open;
}

// How open faces are for the flow, `gap`, by what solids leave of the `volume` around them.
// Between full cells bodies leave what they leave of the volume, but where they are thin, of the
// area: by volume a plate of a cell's thickness would let water through, by area a thick body would
// take water with it that flows around it. Those that the water moves leave less than of the volume
// only where they are plates deeper than a cell under the surface; the water that this encloses
// goes with them (entrained.cl). Nearer to the surface areas open and close at once while a body
// sways, and water at its edge would jump.
// Between a cell that holds water and one that does not, a face is no more open than the surface
// between them: water that a solid lies flat on has none. `held`: of the water around a face, the
// part that goes with the solid. `excess`: between full cells, volume less area; at first
// it has what cut_cells found at the floor, and keeps that beneath full cells. `airless`: 1 where a
// cell holds water or no open space, for the next step.
kernel void open_areas(constant FluidParams* p, constant MacGrid* g, constant BodyShape* shapes,
                       global const float* meshes, global const BodyStep* bodies, int first_body,
                       int body_count, float piston, global const int* owner,
                       global const float* fill, global const float* volume, global float* gap,
                       global const float* depth, global const float* room,
                       global float* held, global float* excess, global float* airless) {
  const Cells at = cells_of(g, get_global_id(0));
  const MacLevel l = g->level[0];
  if (at.z > l.nz) return;
  const int c = at.first;
  const int step[3] = {1, l.row, l.layer};
  const lane_flags here[3] = {at.x, at.y, (lane_flags)(at.z)};
  const int count[3] = {l.nx, l.ny, l.nz};
  const Solids solids = {shapes, meshes, bodies, first_body, body_count, piston};
  const lanes none = 0.0f, one = 1.0f;
  const lane_flags shut = LOAD(room, c) <= (lanes)(LEAST_SEEN);
  STORE(select(none, one, at.inside & (shut | hold_water(fill, c))), airless, c);
  for (int axis = 0; axis < 3; ++axis) {
    const int s = step[axis], first = axis * l.cells + c;
    const lanes open = LOAD(volume, first);
    STORE(open, gap, first);
    STORE(none, held, first);
    const lanes above = LOAD(fill, c), below = LOAD(fill, c - s);
    const lane_flags wet_above = above > (lanes)(MAC_FULL), wet_below = below > (lanes)(MAC_FULL);
    const bool floor = axis == 2 && at.z == 0;
    STORE(floor ? select(none, LOAD(excess, first), wet_above) : none, excess, first);
    const lane_flags cut = at.real & (here[axis] > (lane_flags)(0)) &
                           (here[axis] < (lane_flags)(count[axis])) & (open > none) &
                           (open < one) & (wet_above | wet_below);
    if (!any_lane(cut)) continue;
    const lanes part =
        select(way_to_surface(below, above), 1.0f - way_to_surface(above, below), wet_above);
    int x[LANES], y[LANES], is_cut[LANES], is_full[LANES];
    float up[LANES];
    STORE(at.x, x, 0);
    STORE(at.y, y, 0);
    STORE(cut, is_cut, 0);
    STORE(wet_above & wet_below, is_full, 0);
    STORE(part, up, 0);
    for (int lane = 0; lane < LANES; ++lane) {
      if (!is_cut[lane]) continue;
      const int face = first + lane;
      const int4 cell = (int4)(x[lane], y[lane], at.z, 0);
      const int whose = owner[c + lane] >= 0 ? owner[c + lane] : owner[c + lane - s];
      const bool sides = whose >= 0 && shapes[whose].free;
      if (!is_full[lane]) {
        const float open_here = open_surface(p, g, &solids, cell, axis, up[lane], sides);
        gap[face] = fmin(volume[face], open_here);
        held[face] = 1.0f - gap[face] / volume[face];
        continue;
      }
      const int over = c + lane + l.layer;
      const bool deep = fill[over] > MAC_FULL && fill[over - s] > MAC_FULL;
      if (whose < 0 || (shapes[whose].free && !deep)) continue;
      const float thin = thinness(l, axis, c + lane, depth);
      if (thin == 0.0f) continue;
      const float plate = plate_share(volume[face], volume[face - s], volume[face + s]);
      float with;
      const float area = open_area(p, g, &solids, cell, axis, volume[face], plate, sides, &with);
      if (shapes[whose].free) {
        gap[face] = volume[face] + thin * plate * fmin(area - volume[face], 0.0f);
        with = 1.0f - gap[face] / volume[face];
      } else {
        gap[face] = volume[face] + thin * (area - volume[face]);
        with *= thin;
      }
      held[face] = with;
      excess[face] = volume[face] - gap[face];
    }
  }
}
