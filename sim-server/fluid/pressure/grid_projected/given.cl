// SPDX-License-Identifier: MIT
// The momentum that felt bodies give the particles beyond the grid's pressures on them (felt.cl).
// The pressure at a face acts on the open part of the volume around it, but its change of velocity
// goes to the particles there: too few behind a body, too many in front of it. Spacing, and moving
// particles that have entered a body back out of it, also change velocities. A body's force F that
// counts all this is the momentum that the water around it loses per second:
//   dt F = - rho0 V K^T f - sum_faces (sum_i m w_i du / W_i - I) - sum_i m jolt_i
//   I = rho0 V (open ((f' - f) / h + dt g t) + excess dt g)
// over the faces of the cells that the body owns (room.h) or that are near it, with the weights w
// of move.cl, and over the particles that are nearer to it than to any other body. du: change of
// velocity at a face by pressure, gravity and solids that cover it; t: part of the distance between
// the two cell centres that is water; open, excess: of the face (open_areas.cl). In still water du
// and I are zero but for the excess, so that the weight of a few particles too many or too few does
// not count as a force. The derivative of F by a component of the body's velocity is the same sum
// with A^-1 K of that component for f, and without g and jolt. Over all other faces, far off, the
// same sum is taken with the answer to the body's flow (felt.cl) for f, as they give particles too
// much or too little of any pressure: of what the waves do there on their own the body feels
// nothing.

#include "sim-server/fluid/boundary/bodies.h"
#include "sim-server/fluid/boundary/body_face.h"
#include "sim-server/fluid/lanes/lanes.h"
#include "sim-server/fluid/lanes/team.h"
#include "sim-server/fluid/params/fluid_params.h"
#include "sim-server/fluid/pressure/grid_projected/coupling.h"
#include "sim-server/fluid/pressure/grid_projected/mac_cell.h"
#include "sim-server/fluid/pressure/grid_projected/mac_grid.h"
#include "sim-server/fluid/pressure/grid_projected/room.h"
#include "sim-server/fluid/pressure/grid_projected/surface.h"

#define FACES_BEYOND 2.0f  // the box of a body, its faces are [edges]

static float3 edge_of(constant MacGrid* g) {
  return (float3)(g->hx, g->hy, g->hz);
}

// For each face: `whose`, the index among the felt bodies of the one it belongs to, or OF_NOBODY;
// `given`, du [m/s]; `taken`, I [N s]. A face belongs to the owner of the cell above it, else of
// the cell below it, and, if no body owns either, to the first felt body near it. `falls`: the time
// for which gravity acts [s]. Of the derivative by velocity component `part` of felt body `only`,
// if that is not negative; or, if `part` is SPLASH_BY_FLOW, of the answer to its flow, and then all
// faces far off are its and no others.
kernel void mark_faces(constant FluidParams* p, constant MacGrid* g, float falls, int only,
                       int part, int felt_count, constant FreeBody* felt,
                       global const BodyStep* bodies, int first_body, global const int* owner,
                       global const float* gap, global const float* held,
                       global const float* excess, global const float* fill,
                       global const float* wet, global const float* found,
                       global const float* change, global float* given, global float* taken,
                       global float* whose) {
  const int4 at = cell_of(g, get_global_id(0));
  if (at.w == 0) return;
  const MacLevel l = g->level[0];
  const int c = number_of(l, at);
  const int step[3] = {1, l.row, l.layer};
  const float inverse[3] = {g->ix, g->iy, g->iz};
  const float heavy = p->rest_density * g->hx * g->hy * g->hz;
  const bool afar = part == SPLASH_BY_FLOW;
  for (int axis = 0; axis < 3; ++axis) {
    const int below = c - step[axis], face = axis * l.cells + c;
    const int where = axis == 0 ? at.x : axis == 1 ? at.y : at.z;
    const int cells = axis == 0 ? l.nx : l.ny;  // upwards there is no upper wall
    const bool wall = where == 0 || (axis < 2 && where == cells), floor = wall && axis == 2;
    const int whom = owner[c] == OF_NOBODY && !wall ? owner[below] : owner[c];
    const float3 place = face_middle(g, at, axis), far = FACES_BEYOND * edge_of(g);
    int of = OF_NOBODY;
    for (int k = 0; k < felt_count && (!wall || floor) && of == OF_NOBODY; ++k) {
      const bool around_it =
          bodies_near_box(bodies, first_body + felt[k].body, 1, place - far, place + far);
      if (whom == felt[k].body || (whom == OF_NOBODY && around_it)) of = k;
    }
    if (afar) of = of == OF_NOBODY && !wall ? only : OF_NOBODY;
    whose[face] = of;
    given[face] = taken[face] = 0.0f;
    const float fall = falls * (axis == 0   ? p->gravity_x - p->pull_x * (place.x - p->centre_x)
                                : axis == 1 ? p->gravity_y - p->pull_y * (place.y - p->centre_y)
                                            : p->gravity_z - p->pull_z * (place.z - p->centre_z));
    if (wall) {
      if (of != OF_NOBODY) taken[face] = heavy * excess[face] * fall;
      continue;
    }
    const bool here = wet[c] > 0.0f, there = wet[below] > 0.0f;
    const float way = here == there ? 1.0f
                      : here        ? way_to_surface_of(fill[c], fill[below])
                                    : way_to_surface_of(fill[below], fill[c]);
    const float rise = (here ? found[c] : 0.0f) - (there ? found[below] : 0.0f);
    const float grows = rise / way * inverse[axis];
    if (of != OF_NOBODY && (here || there)) {
      taken[face] = heavy * (gap[face] * way * (fall - grows) + excess[face] * fall);
    }
    if (change[face] >= MAC_KNOWN) continue;
    given[face] = only < 0 ? change[face] : -(1.0f - held[face]) * grows;
    if (only >= 0 && only == of && !afar) {
      const float3 e = (float3)(part % 3 == 0, part % 3 == 1, part % 3 == 2);
      const BodyStep b = bodies[first_body + felt[of].body];
      const float3 arm = place - (float3)(b.px, b.py, b.pz);
      const float3 goes = part < 3 ? e : cross(e, arm) / felt[of].size;
      given[face] += held[face] * (axis == 0 ? goes.x : axis == 1 ? goes.y : goes.z);
    }
  }
}

#define GIVEN_PARTS (SPLASH_PUSH_PARTS + 1)  // of each body: the water's, and that of the faces

// Sum of -I over the faces of each felt body, or of body `only` if that is not negative. One
// work-group.
kernel void weigh_faces(constant MacGrid* g, int felt_count, int only, int part,
                        constant FreeBody* felt, global const BodyStep* bodies, int first_body,
                        global const float* taken, global const float* whose, global float* parts) {
  local float of_team[JUDGES];
  const MacLevel l = g->level[0];
  for (int k = 0; k < felt_count; ++k) {
    if (only >= 0 && k != only) continue;
    const BodyStep b = bodies[first_body + felt[k].body];
    BodyStep wide = b;
    const float cells = part == SPLASH_BY_FLOW ? l.nx + l.ny + l.nz : FACES_BEYOND + 1.0f;
    const float3 far = cells * edge_of(g);
    wide.lower_x -= far.x;
    wide.lower_y -= far.y;
    wide.lower_z -= far.z;
    wide.upper_x += far.x;
    wide.upper_y += far.y;
    wide.upper_z += far.z;
    CellBox box = cells_near(g, wide);
    box.many += 1;  // with the upper faces of the last cells
    float sum[6] = {0.0f, 0.0f, 0.0f, 0.0f, 0.0f, 0.0f};
    for (int item = FIRST_ITEM; item < box.many.x * box.many.y * box.many.z; item += ITEMS) {
      const int c = cell_in(l, box, item);
      const int4 at = (int4)(c % l.layer % l.row, c % l.layer / l.row, c / l.layer, 1) - 1;
      for (int axis = 0; axis < 3; ++axis) {
        const int face = axis * l.cells + c;
        if (whose[face] != k) continue;
        const float3 e = (float3)(axis == 0, axis == 1, axis == 2);
        const float3 arm = face_middle(g, at, axis) - (float3)(b.px, b.py, b.pz);
        const float3 push = -taken[face] * e;
        const float3 turn = cross(arm, push);
        sum[0] += push.x;
        sum[1] += push.y;
        sum[2] += push.z;
        sum[3] += turn.x;
        sum[4] += turn.y;
        sum[5] += turn.z;
      }
    }
    for (int e = 0; e < 6; ++e) {
      const float all = of_all(sum[e], of_team);
      if (FIRST_ITEM == 0) parts[6 * (k * GIVEN_PARTS + SPLASH_PUSH_PARTS) + e] = all;
    }
  }
}

// Change of the particles' velocity along an axis through the faces of felt body `k` [m/s].
static lanes given_along(constant MacGrid* g, const Placed* at, int axis, int k,
                         global const float* change, global const float* given,
                         global const float* whose) {
  const Around a = around(g, at, axis);
  const int first = axis * g->level[0].cells;
  lanes known[8], value[8], of[8];
  load_around(&a, change + first, known);
  load_around(&a, given + first, value);
  load_around(&a, whose + first, of);
  const lanes none = 0.0f;
  lanes sum = 0.0f, weight = 0.0f;
  for (int c = 0; c < 8; ++c) {
    const lanes w = select(none, a.weight[c], known[c] < (lanes)(MAC_KNOWN));
    sum += select(none, w * value[c], (w > none) & (of[c] == (lanes)(k)));
    weight += w;
  }
  return select(none, sum / weight, at->on_grid & (weight > (lanes)(MAC_SEEN)));
}

// Momentum that one part of the particles got from one body [N s]: one work-group for each body
// and part. The particles have been moved by `carried` [m/s]; the grid's weights are those of the
// places before. `jolt`: the bodies' other changes of velocity (move.cl) [m/s], added if `counts`
// is not 0.
kernel void weigh_given(constant FluidParams* p, constant MacGrid* g, float dt, int only,
                        int part_of_speed, int counts, constant FreeBody* felt,
                        constant BodyShape* shapes, global const float* meshes,
                        global const BodyStep* bodies, int first_body, int body_count,
                        global const float* change, global const float* given,
                        global const float* whose, global const float* position,
                        global const float* carried, global const float* jolt,
                        global float* parts) {
  local float of_team[6 * TEAM];
  const int n = p->capacity;
  const int number = get_group_id(0), item = get_local_id(0), items = get_local_size(0);
  const int k = number / SPLASH_PUSH_PARTS, part = number % SPLASH_PUSH_PARTS;
  if (only >= 0 && k != only) return;
  const Share share = share_of(p->count, part, SPLASH_PUSH_PARTS, LANES, LANES);
  const int body = first_body + felt[k].body;
  const BodyStep b = bodies[body];
  const bool afar = part_of_speed == SPLASH_BY_FLOW;
  const float3 beyond = (FACES_BEYOND + 2.0f) * edge_of(g);
  const lanes none = 0.0f;
  lanes sum[6] = {0.0f, 0.0f, 0.0f, 0.0f, 0.0f, 0.0f};
  for (int i = share.first; i < share.last; i += share.step) {
    const lane_flags here = LANE_NUMBERS < (lane_flags)(share.last - i);
    lanes x[3], got[3];
    for (int axis = 0; axis < 3; ++axis) {
      x[axis] = LOAD(position + axis * n, i) - dt * LOAD(carried + axis * n, i);
    }
    const float3 lower = (float3)(least(select((lanes)(FAR_AWAY), x[0], here)),
                                  least(select((lanes)(FAR_AWAY), x[1], here)),
                                  least(select((lanes)(FAR_AWAY), x[2], here)));
    const float3 upper = (float3)(most(select((lanes)(-FAR_AWAY), x[0], here)),
                                  most(select((lanes)(-FAR_AWAY), x[1], here)),
                                  most(select((lanes)(-FAR_AWAY), x[2], here)));
    if (!afar && !bodies_near_box(bodies, body, 1, lower - beyond, upper + beyond)) continue;
    const Placed at = place_on_grid(g, x[0], x[1], x[2]);
    lane_flags own = 0;
    if (counts) {
      const BodyFace nearest =
          nearest_face(shapes, meshes, bodies, first_body, body_count, x[0], x[1], x[2]);
      own = nearest.owner == (lanes)(felt[k].body);
    }
    for (int axis = 0; axis < 3; ++axis) {
      got[axis] = given_along(g, &at, axis, k, change, given, whose) +
                  select(none, LOAD(jolt + axis * n, i), own);
      got[axis] = select(none, got[axis], here);
    }
    const lanes rx = x[0] - b.px, ry = x[1] - b.py, rz = x[2] - b.pz;
    sum[0] += got[0];
    sum[1] += got[1];
    sum[2] += got[2];
    sum[3] += select(none, ry * got[2] - rz * got[1], here);
    sum[4] += select(none, rz * got[0] - rx * got[2], here);
    sum[5] += select(none, rx * got[1] - ry * got[0], here);
  }
  for (int e = 0; e < 6; ++e) of_team[e * TEAM + item] = total(sum[e]);
  barrier(CLK_LOCAL_MEM_FENCE);
  for (int e = item; e < 6; e += items) {
    float all = of_team[e * TEAM];
    for (int other = 1; other < items; ++other) all += of_team[e * TEAM + other];
    parts[6 * (k * GIVEN_PARTS + part) + e] = p->mass * all;
  }
}

// One work-item for each body: subtracts the momentum that it gave from the first half of its
// `sums`; or what `only` gave far off, without its moment, if that is not negative and `part` is
// SPLASH_BY_FLOW; else adds the derivative by velocity component `part` of that body to the second
// half.
kernel void sum_given(int felt_count, int only, int part, constant FreeBody* felt,
                      global const float* parts, global float* sums) {
  const int k = get_global_id(0);
  if (k >= felt_count || (only >= 0 && k != only)) return;
  for (int e = 0; e < 6; ++e) {
    float all = 0.0f;
    for (int one = 0; one < GIVEN_PARTS; ++one) all += parts[6 * (k * GIVEN_PARTS + one) + e];
    if (only < 0 || (part == SPLASH_BY_FLOW && e < 3)) sums[12 * k + e] -= all;
    if (only >= 0 && e == part) sums[12 * k + 6 + e] += (e < 3 ? 1.0f : felt[k].size) * all;
  }
}
