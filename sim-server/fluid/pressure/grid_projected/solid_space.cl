// SPDX-License-Identifier: MIT
// What solids leave open around faces and cells, put together from what they leave of the halves of
// cells (solids.cl); and where water touches bodies.

#include "sim-server/fluid/boundary/bodies.h"
#include "sim-server/fluid/boundary/body_face.h"
#include "sim-server/fluid/lanes/lanes.h"
#include "sim-server/fluid/neighbours/grid.h"
#include "sim-server/fluid/params/fluid_params.h"
#include "sim-server/fluid/pressure/grid_projected/mac_cell.h"
#include "sim-server/fluid/pressure/grid_projected/mac_grid.h"
#include "sim-server/fluid/pressure/grid_projected/solids.h"

#define TOUCHES 0.75f  // bodies so near to a particle touch it, at rest half of one [spacings]
#define CLEAR 1.0f     // bodies that are farther off do not [spacings]

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

// The open part of the volume around faces. Of the tank's faces it is the area that is open, and
// the piston's wall is behind it.
static void open_faces(constant FluidParams* p, const MacLevel l, const Cells* at,
                       const OpenHalves* open, global float* volume) {
  const int step[3] = {1, l.row, l.layer};
  const lane_flags here[3] = {at->x, at->y, at->z};
  const int count[3] = {l.nx, l.ny, l.nz};
  const lanes none = 0.0f;
  for (int axis = 0; axis < 3; ++axis) {
    const int face = axis * l.cells + at->first;
    const lane_flags first = here[axis] == (lane_flags)(0);
    const lane_flags last = here[axis] == (lane_flags)(count[axis]);
    const lanes above = LOAD(open->lower, face), below = LOAD(open->upper, face - step[axis]);
    lanes part = select(select(0.5f * (above + below), above, first), below, last);
    if (HAS_PISTON && p->piston >= 0 && axis == 0) part = select(part, none, first);
    const lane_flags closed = part < (lanes)(LEAST_GAP);
    STORE(select(select(part, none, closed), none, at->real == (lane_flags)(0)), volume, face);
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

// `seen`: what the hats of cells see of open space, of those that are some solid's; 1 of all
// others. Of closed cells it is not needed, and 0 stands for it. `clear`, for cells of whose hat a
// body hides a part: 1 if no particle near the cell touches a body, 0 if one does, in between by
// its distance. Where it is 1, the hidden part counts as empty.
kernel void see_space(constant FluidParams* p, constant MacGrid* g, constant BodyShape* shapes,
                      global const float* meshes, global const BodyStep* bodies, int first_body,
                      int body_count, global const int* cell_start, global const float* position,
                      global const float* lower, global const float* upper,
                      global const float* room, global const int* owner, global float* volume,
                      global float* seen, global float* clear) {
  const Cells at = cells_of(g, get_global_id(0));
  const MacLevel l = g->level[0];
  if (at.z > l.nz) return;
  const OpenHalves open = {lower, upper, room};
  open_faces(p, l, &at, &open, volume);
  const lanes none = 0.0f, one = 1.0f, own = LOAD(room, at.first);
  const lane_flags owned = at.inside & (LOAD(owner, at.first) != (lane_flags)(OF_NOBODY));
  STORE(select(one, none, owned & (own <= none)), seen, at.first);
  STORE(none, clear, at.first);
  if (!any_lane(owned)) return;
  const Solids solids = {shapes, meshes, bodies, first_body, body_count, 0.0f};
  int x[LANES], y[LANES], is_owned[LANES];
  STORE(at.x, x, 0);
  STORE(at.y, y, 0);
  STORE(owned, is_owned, 0);
  for (int lane = 0; lane < LANES; ++lane) {
    if (!is_owned[lane]) continue;
    const int c = at.first + lane;
    const int4 cell = (int4)(x[lane], y[lane], at.z, 1);
    if (room[c] > 0.0f) seen[c] = room_seen(l, &open, cell);
    if (owner[c] < 0 || seen[c] >= 1.0f) continue;
    const float way = way_to_bodies(p, g, &solids, cell, cell_start, position);
    clear[c] = (way - TOUCHES) / (CLEAR - TOUCHES);
  }
}
