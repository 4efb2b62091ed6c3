// SPDX-License-Identifier: MIT
// Where solids are in the grid: how much they leave open of the volume around each face, half a
// cell to either side (Batty, Bertails & Bridson 2007), of its area (Ng, Min & Gibou 2009), and of
// each cell, by the distances of places half a cell apart from the nearest outline. Between these
// they are taken as linear, so a flat face is where it is, and what a body displaces is its volume.
// A cell that a solid cuts is as full as its water fills what the hat sees of open space around it.

#include "sim-server/fluid/boundary/bodies.h"
#include "sim-server/fluid/boundary/body_face.h"
#include "sim-server/fluid/boundary/walls.h"
#include "sim-server/fluid/lanes/lanes.h"
#include "sim-server/fluid/neighbours/grid.h"
#include "sim-server/fluid/params/fluid_params.h"
#include "sim-server/fluid/pressure/grid_projected/mac_cell.h"
#include "sim-server/fluid/pressure/grid_projected/mac_grid.h"
#include "sim-server/fluid/pressure/grid_projected/room.h"
#include "sim-server/fluid/pressure/grid_projected/surface.h"

#define LEAST_SEEN 1e-4f  // cells that see less open space are full of nothing [1]
#define OWN_WEIGHT 0.05f  // of a cell's own fill in the estimate of what its hat cannot see [1]
#define LEAST_GAP 1e-3f   // faces that are less open are closed [1]
#define TOUCHES 0.75f     // bodies so near to a particle touch it, at rest half of one [spacings]
#define CLEAR 1.0f        // bodies that are farther off do not [spacings]
#define SECTIONS 4        // between two cells' middles, in which a thin plate is looked for
#define LESS_CLOSED 0.25f // a thin plate leaves faces open that are so much less closed [1]

// Part of a tetrahedron where a linear distance is positive, from those of its corners [1].
static float open_tetrahedron(float a, float b, float c, float d) {
  const int closed = (a <= 0.0f) + (b <= 0.0f) + (c <= 0.0f) + (d <= 0.0f);
  if (closed == 0) return 1.0f;
  if (closed == 4) return 0.0f;
  float s[4] = {a, b, c, d};  // the open ones first
  for (int k = 0, next = 0; k < 4; ++k) {
    if (s[k] <= 0.0f) continue;
    const float swap = s[next];
    s[next++] = s[k];
    s[k] = swap;
  }
  if (closed == 3) return s[0] * s[0] * s[0] / ((s[0] - s[1]) * (s[0] - s[2]) * (s[0] - s[3]));
  if (closed == 1) {
    return 1.0f - s[3] * s[3] * s[3] / ((s[3] - s[0]) * (s[3] - s[1]) * (s[3] - s[2]));
  }
  const float ab = s[0] * s[1], cd = s[2] * s[3], open = s[0] + s[1];
  return (ab * ab - (s[2] + s[3]) * ab * open + cd * (open * open - ab)) /
         ((s[0] - s[2]) * (s[0] - s[3]) * (s[1] - s[2]) * (s[1] - s[3]));
}

// Of a box, from the distances of its eight corners, x first: six tetrahedra around the diagonal
// from the first to the last (Kuhn 1960).
static float open_box(const float* d) {
  float low = d[0], high = d[0];
  for (int k = 1; k < 8; ++k) {
    low = fmin(low, d[k]);
    high = fmax(high, d[k]);
  }
  if (low > 0.0f) return 1.0f;
  if (high <= 0.0f) return 0.0f;
  return (open_tetrahedron(d[0], d[1], d[3], d[7]) + open_tetrahedron(d[0], d[1], d[5], d[7]) +
          open_tetrahedron(d[0], d[2], d[3], d[7]) + open_tetrahedron(d[0], d[2], d[6], d[7]) +
          open_tetrahedron(d[0], d[4], d[5], d[7]) + open_tetrahedron(d[0], d[4], d[6], d[7])) /
         6.0f;
}

// Corners of one of the eight boxes that 27 places, x first, make; the first is the middle's.
static void corners_of(const float* d, int box, float* corner) {
  const int x = box & 1 ? 1 : -1, y = box & 2 ? 3 : -3, z = box & 4 ? 9 : -9;
  for (int k = 0; k < 8; ++k) {
    corner[k] = d[13 + (k & 1 ? x : 0) + (k & 2 ? y : 0) + (k & 4 ? z : 0)];
  }
}

// The kernel arguments that describe bodies and piston.
typedef struct {
  constant BodyShape* shapes;
  global const float* meshes;
  global const BodyStep* bodies;
  int first, count;
  float piston;
} Solids;

// How far the nearest solid is, and whose it is: of the bodies that may be within the support of
// the box from `lower` to `upper`.
static lanes solid_distance(constant FluidParams* p, const Solids* s, float3 lower, float3 upper,
                            lanes x, lanes y, lanes z, lanes* owner) {
  const BodyFace face = nearest_face_near(s->shapes, s->meshes, s->bodies, s->first, s->count,
                                          lower, upper, x, y, z);
  lanes distance = face.distance;
  *owner = s->count > 0 ? face.owner : (lanes)(OF_NOBODY);
  if (has_slope(p)) {
    const lanes above = wall_distance(p, p->slope, x, y, z, s->piston);
    *owner = select(*owner, (lanes)(OF_SLOPE), above < distance);
    distance = fmin(distance, above);
  }
  if (HAS_PISTON && p->piston >= 0) {
    const lanes before = wall_distance(p, p->piston, x, y, z, s->piston);
    *owner = select(*owner, (lanes)(OF_PISTON), before < distance);
    distance = fmin(distance, before);
  }
  return distance;
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
static int measure_box(constant FluidParams* p, const Solids* s, float3 lower, float3 apart,
                       float beyond, float* distance) {
  int owner = OF_NOBODY;
  for (int first = 0; first < 27; first += LANES) {
    float place[3][LANES];
    for (int lane = 0; lane < LANES; ++lane) {
      const int k = min(first + lane, 26);
      place[0][lane] = lower.x + (k % 3) * apart.x;
      place[1][lane] = lower.y + (k / 3 % 3) * apart.y;
      place[2][lane] = lower.z + (k / 9) * apart.z;
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
static float open_eighth(constant FluidParams* p, const Solids* s, float3 lower, float3 edge,
                         const float* corner, bool flat) {
  const float whole = open_box(corner);
  if (flat || !(whole > 0.0f && whole < 1.0f)) return whole;
  float d[27], sum = 0.0f;
  measure_box(p, s, lower, 0.5f * edge, 0.0f, d);
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
// the tank's walls of their area, and of all of them, `room`. `owner`: whose they are.
typedef struct {
  global float* lower;
  global float* upper;
  global float* room;
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
  const int whose = measure_box(p, solids, low, edge, fmax(owned_within(g) - p->support, 0.0f), d);
  if (d[13] < owned_within(g)) parts->owner[c] = whose;
  float nearest = d[0];
  for (int k = 1; k < 27; ++k) nearest = fmin(nearest, d[k]);
  if (nearest > 0.0f) return;
  float of_half[6] = {0.0f, 0.0f, 0.0f, 0.0f, 0.0f, 0.0f}, sum = 0.0f;
  for (int k = 0; k < 8; ++k) {
    const int x = k & 1, y = k >> 1 & 1, z = k >> 2;
    float corner[8];
    corners_of(d, k, corner);
    const float3 from = low + edge * (float3)(x, y, z);
    const float open = 0.25f * open_eighth(p, solids, from, edge, corner, flat);
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
                      global float* room, global int* owner) {
  const Cells at = cells_of(g, get_global_id(0));
  const MacLevel l = g->level[0];
  if (at.z > l.nz) return;
  const lanes none = 0.0f, one = 1.0f, open = select(none, one, at.real);
  for (int axis = 0; axis < 3; ++axis) {
    STORE(open, lower + axis * l.cells, at.first);
    STORE(open, upper + axis * l.cells, at.first);
  }
  STORE(open, room, at.first);
  STORE((lane_flags)(OF_NOBODY), owner, at.first);
  const Solids solids = {shapes, meshes, bodies, first_body, body_count, piston};
  if (!solids_near_cells(p, g, &solids, &at)) return;
  const OpenParts parts = {lower, upper, room, owner};
  int x[LANES], y[LANES], real[LANES];
  STORE(at.x, x, 0);
  STORE(at.y, y, 0);
  STORE(at.real, real, 0);
  for (int lane = 0; lane < LANES; ++lane) {
    if (!real[lane]) continue;
    cut_cell(p, g, &solids, (int4)(x[lane], y[lane], at.z, 1), at.first + lane, &parts);
  }
}

// What solids leave open of cells: of their `lower` and `upper` halves along the axes, and of all
// of them, `room`.
typedef struct {
  global const float* lower;
  global const float* upper;
  global const float* room;
} OpenHalves;

// What the hat of a cell's middle sees of open space: 3/4 of its weight is in the cell itself along
// each axis, an eighth in the nearer half of the cell on either side, or of its own mirror image
// behind a wall of the tank.
static float room_seen(const MacLevel l, const OpenHalves* open, int4 at) {
  float sum = 0.0f;
  for (int k = 0; k < 27; ++k) {
    const int side[3] = {k % 3 - 1, k / 3 % 3 - 1, k / 9 - 1};
    const int4 there =
        (int4)(clamp(at.x + side[0], 0, l.nx - 1), clamp(at.y + side[1], 0, l.ny - 1),
               clamp(at.z + side[2], 0, l.nz - 1), 1);
    const int inside[3] = {at.x + side[0] == there.x, at.y + side[1] == there.y,
                           at.z + side[2] == there.z};
    const int c = number_of(l, there);
    const float all = open->room[c];
    float part = 1.0f, nearer = all;
    for (int axis = 0; axis < 3; ++axis) {
      part *= side[axis] ? 0.125f : 0.75f;
      if (!side[axis] || all < LEAST_SEEN) continue;
      global const float* next = (side[axis] > 0) == inside[axis] ? open->lower : open->upper;
      nearer *= next[axis * l.cells + c] / all;
    }
    sum += part * fmin(nearer, 1.0f);
  }
  return sum;
}

// What cells see of open space: of those that are some solid's; 1 of all others. Of closed cells it
// is not needed, and 0 stands for it.
kernel void see_room(constant MacGrid* g, global const float* lower, global const float* upper,
                     global const float* room, global const int* owner, global float* seen) {
  const Cells at = cells_of(g, get_global_id(0));
  const MacLevel l = g->level[0];
  if (at.z > l.nz) return;
  const lane_flags owned = at.inside & (LOAD(owner, at.first) != (lane_flags)(OF_NOBODY));
  const lanes none = 0.0f, one = 1.0f, own = LOAD(room, at.first);
  const lane_flags cut = owned & (own > none);
  STORE(select(one, none, owned & (own <= none)), seen, at.first);
  if (!any_lane(cut)) return;
  const OpenHalves open = {lower, upper, room};
  int x[LANES], y[LANES], is_cut[LANES];
  STORE(at.x, x, 0);
  STORE(at.y, y, 0);
  STORE(cut, is_cut, 0);
  for (int lane = 0; lane < LANES; ++lane) {
    if (is_cut[lane]) {
      seen[at.first + lane] = room_seen(l, &open, (int4)(x[lane], y[lane], at.z, 0));
    }
  }
}

// From halves to faces: `volume` begins as the lower ones. Of the tank's faces it is the area that
// is open, and the piston's wall is behind it.
kernel void open_faces(constant FluidParams* p, constant MacGrid* g, global const float* upper,
                       global float* volume) {
  const Cells at = cells_of(g, get_global_id(0));
  const MacLevel l = g->level[0];
  if (at.z > l.nz) return;
  const int step[3] = {1, l.row, l.layer};
  const lane_flags here[3] = {at.x, at.y, at.z};
  const int count[3] = {l.nx, l.ny, l.nz};
  const lanes none = 0.0f;
  for (int axis = 0; axis < 3; ++axis) {
    const int face = axis * l.cells + at.first;
    const lane_flags first = here[axis] == (lane_flags)(0);
    const lane_flags last = here[axis] == (lane_flags)(count[axis]);
    const lanes above = LOAD(volume, face), below = LOAD(upper, face - step[axis]);
    lanes open = select(select(0.5f * (above + below), above, first), below, last);
    if (HAS_PISTON && p->piston >= 0 && axis == 0) open = select(open, none, first);
    const lane_flags closed = open < (lanes)(LEAST_GAP);
    STORE(select(select(open, none, closed), none, at.real == (lane_flags)(0)), volume, face);
  }
}

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

// How much of the surface solids leave open, between the middles of cell `c` at `at` and the one
// below it along an axis, `part` of the way up [1].
static float open_surface(constant FluidParams* p, constant MacGrid* g, const Solids* s, int4 at,
                          int axis, float part) {
  const float edge[3] = {g->hx, g->hy, g->hz}, from[3] = {g->x, g->y, g->z};
  const int cell[3] = {at.x, at.y, at.z};
  const int across[2] = {(axis + 1) % 3, (axis + 2) % 3};
  float place[3][16], d[16];  // nine places, and the last one again for whole vectors
  for (int n = 0; n < 16; ++n) {
    const int k = min(n, 8);
    place[axis][n] = from[axis] + (cell[axis] - 0.5f + part) * edge[axis];
    place[across[0]][n] = from[across[0]] + (cell[across[0]] + 0.5f * (k % 3)) * edge[across[0]];
    place[across[1]][n] = from[across[1]] + (cell[across[1]] + 0.5f * (k / 3)) * edge[across[1]];
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

// What a body leaves open of the area of a face between two full cells: `volume` is what it leaves
// of the volume around the face, and `beside` of that around the next faces along the axis, the
// less of both. A plate thinner than a cell may be between two faces, which are then more open than
// their volumes. The one whose volume it closes more is as open as its widest section leaves it;
// the nearer the other one comes to that, the more so is it. A thicker body closes the next face
// entirely, and this one is as it is.
// `held`: of what is open around the face, the part that such a plate closes.
static float open_area(constant FluidParams* p, constant MacGrid* g, const Solids* s, int4 at,
                       int axis, float volume, float beside, float* held) {
  const float here = open_surface(p, g, s, at, axis, 0.5f);
  const float share = clamp(1.0f - (volume - beside) / LESS_CLOSED, 0.0f, 1.0f);
  const bool between = here > volume && share > 0.0f;
  float least = here;
  for (int k = 0; k < SECTIONS && between; ++k) {
    least = fmin(least, open_surface(p, g, s, at, axis, (k + 0.5f) / SECTIONS));
  }
  const float open = here + share * (least - here);
  *held = open < LEAST_GAP ? 1.0f : 1.0f - open / here;
  return open < LEAST_GAP ? 0.0f : open;
}

// How open faces are for the flow, `gap`, by what solids leave of the `volume` around them.
// Between full cells bodies that go their own way leave what they leave of the area: by volume a
// plate of a cell's thickness would let water through, and a body's edge more than there is room
// for. Those that the water moves are borne evenly by volumes only. Between a cell that holds water
// and one that does not, a face is no more open than the surface between them: water that a solid
// lies flat on has none. `held`: of the water around a face, the part that goes with the solid.
// `excess`: between full cells, volume less area.
kernel void open_areas(constant FluidParams* p, constant MacGrid* g, constant BodyShape* shapes,
                       global const float* meshes, global const BodyStep* bodies, int first_body,
                       int body_count, float piston, global const int* owner,
                       global const float* fill, global const float* volume, global float* gap,
                       global float* held, global float* excess) {
  const Cells at = cells_of(g, get_global_id(0));
  const MacLevel l = g->level[0];
  if (at.z > l.nz) return;
  const int c = at.first;
  const int step[3] = {1, l.row, l.layer};
  const lane_flags here[3] = {at.x, at.y, (lane_flags)(at.z)};
  const int count[3] = {l.nx, l.ny, l.nz};
  const Solids solids = {shapes, meshes, bodies, first_body, body_count, piston};
  const lanes none = 0.0f, one = 1.0f;
  for (int axis = 0; axis < 3; ++axis) {
    const int s = step[axis], first = axis * l.cells + c;
    const lanes open = LOAD(volume, first);
    STORE(open, gap, first);
    STORE(none, held, first);
    STORE(none, excess, first);
    const lanes above = LOAD(fill, c), below = LOAD(fill, c - s);
    const lane_flags wet_above = above > (lanes)(MAC_FULL), wet_below = below > (lanes)(MAC_FULL);
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
      if (!is_full[lane]) {
        gap[face] = fmin(volume[face], open_surface(p, g, &solids, cell, axis, up[lane]));
        held[face] = 1.0f - gap[face] / volume[face];
        continue;
      }
      const int whose = owner[c + lane] >= 0 ? owner[c + lane] : owner[c + lane - s];
      if (whose < 0 || shapes[whose].free) continue;
      float with;
      gap[face] = open_area(p, g, &solids, cell, axis, volume[face],
                            fmin(volume[face - s], volume[face + s]), &with);
      held[face] = with;
      excess[face] = volume[face] - gap[face];
    }
  }
}
