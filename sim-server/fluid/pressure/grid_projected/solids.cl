// SPDX-License-Identifier: MIT
// Where solids are in the grid: how much they leave open of the volume around each face, half a
// cell to either side (Batty, Bertails & Bridson 2007), and of each cell, by distances half a cell
// apart. What a body displaces is its volume.

#include "sim-server/fluid/boundary/bodies.h"
#include "sim-server/fluid/boundary/walls.h"
#include "sim-server/fluid/lanes/lanes.h"
#include "sim-server/fluid/params/fluid_params.h"
#include "sim-server/fluid/pressure/grid_projected/mac_cell.h"
#include "sim-server/fluid/pressure/grid_projected/mac_grid.h"
#include "sim-server/fluid/pressure/grid_projected/solids.h"

// Corners of one of the eight boxes that 27 places, x first, make; the first is the middle's.
static void corners_of(const float* d, int box, float* corner) {
  const int x = box & 1 ? 1 : -1, y = box & 2 ? 3 : -3, z = box & 4 ? 9 : -9;
  for (int k = 0; k < 8; ++k) {
    corner[k] = d[13 + (k & 1 ? x : 0) + (k & 2 ? y : 0) + (k & 4 ? z : 0)];
  }
}

// Whether any solid may be in a box or those around it.
static bool solids_near(constant FluidParams* p, global const BodyStep* bodies, int first_body,
                        int body_count, float piston, float3 lower, float3 upper) {
  if (bodies_near_box(bodies, first_body, body_count, lower, upper)) return true;
  const float3 middle = 0.5f * (lower + upper);
  const float far = 1.5f * length(upper - lower);  // its neighbours' corners
  for (int turn = 0; turn < 2; ++turn) {
    const int k = turn ? p->piston : p->slope;
    if (!(turn ? HAS_PISTON : HAS_SLOPE) || k < 0) continue;
    if (first_lane(wall_distance(p, k, middle.x, middle.y, middle.z, piston)) < far) return true;
  }
  return false;
}

// Distances of 27 places in a box from its `lower` corner on, `apart` from each other, x first: of
// solids that may be nearer than the support, or than that and `beyond`. Whose the middle is.
// `sides`: as looked_at.
static int measure_box(constant FluidParams* p, constant MacGrid* g, const Solids* s, float3 lower,
                       float3 apart, float beyond, bool sides, float* distance) {
  int owner = OF_NOBODY;
  for (int first = 0; first < 27; first += LANES) {
    float place[3][LANES];
    for (int lane = 0; lane < LANES; ++lane) {
      const int k = min(first + lane, 26);
      const float3 at = looked_at(g, lower + apart * (float3)(k % 3, k / 3 % 3, k / 9), sides);
      place[0][lane] = at.x;
      place[1][lane] = at.y;
      place[2][lane] = at.z;
    }
    lanes whose;
    const lanes far =
        solid_distance(p, s, lower - beyond, lower + 2.0f * apart + beyond, LOAD(place[0], 0),
                       LOAD(place[1], 0), LOAD(place[2], 0), &whose);
    float part[LANES], owners[LANES];
    STORE(far, part, 0);
    STORE(whose, owners, 0);
    for (int lane = 0; lane < LANES && first + lane < 27; ++lane) {
      distance[first + lane] = part[lane];
      if (first + lane == 13) owner = (int)owners[lane];
    }
  }
  return owner;
}

// Of an eighth of a cell with these corners: by its own eighths, and what that changed goes on to
// where it would end (Richardson); what is `flat` is as its corners say.
static float open_eighth(constant FluidParams* p, constant MacGrid* g, const Solids* s,
                         float3 lower, float3 edge, const float* corner, bool flat, bool sides) {
  const float whole = open_box(corner);
  if (flat || !(whole > 0.0f && whole < 1.0f)) return whole;
  float d[27], sum = 0.0f;
  measure_box(p, g, s, lower, 0.5f * edge, 0.0f, sides, d);
  for (int k = 0; k < 8; ++k) {
    float part[8];
    corners_of(d, k, part);
    sum += 0.125f * open_box(part);
  }
  return clamp(sum + (sum - whole) / 3.0f, 0.0f, 1.0f);
}

// Of the area of a side of a cell: lower (0) or upper (2) along an axis.
static float open_side(const float* d, int axis, int side) {
  const int step[3] = {1, 3, 9};
  const int a = step[(axis + 1) % 3], b = step[(axis + 2) % 3];
  float sum = 0.0f;
  for (int k = 0; k < 4; ++k) {
    const int first = side * step[axis] + (k & 1 ? a : 0) + (k & 2 ? b : 0);
    const float flat[8] = {d[first], d[first + a], d[first + b], d[first + a + b],
                           d[first], d[first + a], d[first + b], d[first + a + b]};
    sum += 0.25f * open_box(flat);
  }
  return sum;
}

// Where cells' open parts go: of their halves along the axes, the lower and the `upper` ones, at
// the tank's walls of their area, and of all of them, `room`. `beneath`: of the lower halves of
// cells on the floor, less the open part of their area there. `depth`: how far their places are in
// solids, of those that are half a cell apart the deepest [cells]. `owner`: whose they are.
typedef struct {
  global float* lower;
  global float* upper;
  global float* room;
  global float* beneath;
  global float* depth;
  global int* owner;
} OpenParts;

// Cells whose middle is nearer to a solid are its [m].
static float owned_within(constant MacGrid* g) { return g->hx + g->hy + g->hz; }

// Whether the wave maker's piston may intersect the box from `lower` to `upper`.
static bool piston_near(constant FluidParams* p, const Solids* s, float3 lower, float3 upper) {
  if (!HAS_PISTON || p->piston < 0) return false;
  const float3 middle = 0.5f * (lower + upper);
  return first_lane(wall_distance(p, p->piston, middle.x, middle.y, middle.z, s->piston)) <=
         length(upper - lower);
}

// For a cell that no body is near: true if slope and piston leave the cell entirely open or cover
// it entirely. In that case this writes its open parts, and its corners need not be measured.
static bool is_whole(constant FluidParams* p, constant MacGrid* g, const Solids* s, float3 lower,
                     float3 upper, int c, const OpenParts* parts) {
  const float3 middle = 0.5f * (lower + upper);
  lanes whose;
  const float far =
      first_lane(solid_distance(p, s, lower, upper, middle.x, middle.y, middle.z, &whose));
  if (fabs(far) < 0.501f * length(upper - lower)) return false;
  if (far < owned_within(g)) parts->owner[c] = (int)first_lane(whose);
  if (far > 0.0f) return true;
  for (int axis = 0; axis < 3; ++axis) {
    const int face = axis * g->level[0].cells + c;
    parts->lower[face] = parts->upper[face] = 0.0f;
  }
  parts->room[c] = 0.0f;
  return true;
}

// Cell `c` at `at`, if solids may be near.
static void cut_cell(constant FluidParams* p, constant MacGrid* g, const Solids* solids, int4 at,
                     int c, const OpenParts* parts) {
  const MacLevel l = g->level[0];
  const float3 low = (float3)(g->x + at.x * g->hx, g->y + at.y * g->hy, g->z + at.z * g->hz);
  const float3 high = low + (float3)(g->hx, g->hy, g->hz);
  if (!solids_near(p, solids->bodies, solids->first, solids->count, solids->piston, low, high)) {
    return;
  }
  const bool by_bodies = bodies_near_box(solids->bodies, solids->first, solids->count, low, high);
  if (!by_bodies && is_whole(p, g, solids, low, high, c, parts)) return;
  const bool flat = !by_bodies && !piston_near(p, solids, low, high);  // the slope alone cuts it
  const float3 edge = 0.5f * (float3)(g->hx, g->hy, g->hz);
  float d[27];
  const float beyond = fmax(owned_within(g) - p->support, 0.0f);
  const int whose = measure_box(p, g, solids, low, edge, beyond, false, d);
  const bool beside = at.x == 0 || at.y == 0 || at.x == l.nx - 1 || at.y == l.ny - 1;
  const bool sides = beside && whose >= 0 && solids->shapes[whose].free;
  if (sides) measure_box(p, g, solids, low, edge, beyond, true, d);
  if (d[13] < owned_within(g)) parts->owner[c] = whose;
  float nearest = d[0];
  for (int k = 1; k < 27; ++k) nearest = fmin(nearest, d[k]);
  if (nearest > 0.0f) return;
  parts->depth[c] = -nearest / cbrt(g->hx * g->hy * g->hz);
  float of_half[6] = {0.0f, 0.0f, 0.0f, 0.0f, 0.0f, 0.0f}, sum = 0.0f;
  for (int k = 0; k < 8; ++k) {
    const int x = k & 1, y = k >> 1 & 1, z = k >> 2;
    float corner[8];
    corners_of(d, k, corner);
    const float3 from = low + edge * (float3)(x, y, z);
    const float open = 0.25f * open_eighth(p, g, solids, from, edge, corner, flat, sides);
    of_half[x] += open;
    of_half[2 + y] += open;
    of_half[4 + z] += open;
    sum += 0.5f * open;
  }
  const int here[3] = {at.x, at.y, at.z}, count[3] = {l.nx, l.ny, l.nz};
  for (int axis = 0; axis < 3; ++axis) {
    const int face = axis * l.cells + c;
    parts->lower[face] = here[axis] == 0 ? open_side(d, axis, 0) : of_half[2 * axis];
    parts->upper[face] =
        here[axis] == count[axis] - 1 ? open_side(d, axis, 2) : of_half[2 * axis + 1];
  }
  parts->room[c] = sum;
  if (at.z == 0) parts->beneath[c] = 0.5f * (of_half[4] - parts->lower[2 * l.cells + c]);
}

// Whether a solid may be near any cell of a vector; most vectors have none near them.
static bool solids_near_cells(constant FluidParams* p, constant MacGrid* g, const Solids* s,
                              const Cells* at) {
  const MacLevel l = g->level[0];
  const int from = at->first - (at->z + 1) * l.layer, to = from + LANES - 1;
  const int low_y = from / l.row - 1, high_y = to / l.row - 1;
  const bool one_row = low_y == high_y;
  const int low_x = one_row ? from % l.row - 1 : -1, high_x = one_row ? to % l.row - 1 : l.nx;
  const float3 lower = (float3)(g->x + low_x * g->hx, g->y + low_y * g->hy, g->z + at->z * g->hz);
  const float3 upper =
      lower + (float3)((high_x - low_x + 1) * g->hx, (high_y - low_y + 1) * g->hy, g->hz);
  return solids_near(p, s->bodies, s->first, s->count, s->piston, lower, upper);
}

kernel void cut_cells(constant FluidParams* p, constant MacGrid* g, constant BodyShape* shapes,
                      global const float* meshes, global const BodyStep* bodies, int first_body,
                      int body_count, float piston, global float* lower, global float* upper,
                      global float* room, global float* excess, global float* depth,
                      global int* owner) {
  const Cells at = cells_of(g, get_global_id(0));
  const MacLevel l = g->level[0];
  if (at.z > l.nz) return;
  const lanes none = 0.0f, one = 1.0f, open = select(none, one, at.real);
  for (int axis = 0; axis < 3; ++axis) {
    STORE(open, lower + axis * l.cells, at.first);
    STORE(open, upper + axis * l.cells, at.first);
  }
  STORE(open, room, at.first);
  global float* beneath = excess + 2 * l.cells;
  STORE(none, beneath, at.first);
  STORE(none, depth, at.first);
  STORE((lane_flags)(OF_NOBODY), owner, at.first);
  const Solids solids = {shapes, meshes, bodies, first_body, body_count, piston};
  if (!solids_near_cells(p, g, &solids, &at)) return;
  const OpenParts parts = {lower, upper, room, beneath, depth, owner};
  int x[LANES], y[LANES], real[LANES];
  STORE(at.x, x, 0);
  STORE(at.y, y, 0);
  STORE(at.real, real, 0);
  for (int lane = 0; lane < LANES; ++lane) {
    if (!real[lane]) continue;
    cut_cell(p, g, &solids, (int4)(x[lane], y[lane], at.z, 1), at.first + lane, &parts);
  }
}
