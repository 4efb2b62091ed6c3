// SPDX-License-Identifier: MIT
// No particle stays inside a body. The water around a body pushes with the pressure that the body
// itself causes, and that has no direction deep inside: a drop that got there alone would stay.
// So a particle deeper than half a spacing is put back to that depth below the nearest face, and
// its motion into the body ends. Water in contact never is that deep (0.35 spacings at 1.5 m/s).
// No particle passes through a body, either: one that is thrown so far in one step that another
// side is the nearer one, or that it has come out there, is put back to where it got too deep.

#include "sim-server/fluid/boundary/bodies.h"
#include "sim-server/fluid/boundary/outline.h"
#include "sim-server/fluid/boundary/outline_mesh.h"
#include "sim-server/fluid/lanes/lanes.h"
#include "sim-server/fluid/params/fluid_params.h"

#define KEPT_DEPTH 0.5f     // [spacings]
#define MOST_PROBES 32      // along a particle's way in a step, one each KEPT_DEPTH
#define ENTRY_HALVINGS 14   // of the way between two probes: to 1e-4 of it

// The place, in the body's axes, where a particle that moves from `start` by `way` is first deeper
// than `kept`, and the outward normal there: `start`, if the body has moved over it. False: it
// never is that deep.
static bool entry_of(BodyShape s, global const float* meshes, float kept, float3 start, float3 way,
                     float3* at, float3* out) {
  const float was = depth_inside(s, meshes, start, out);
  *at = start + (was - kept) * *out;
  if (was > kept) return true;
  const int probes = clamp(convert_int_sat(length(way) / kept) + 1, 1, MOST_PROBES);
  int k = 1;
  while (k <= probes &&
         !(depth_inside(s, meshes, start + (float)k / probes * way, out) > kept)) {
    ++k;
  }
  if (k > probes) return false;
  float outside = (float)(k - 1) / probes, inside = (float)k / probes;
  for (int halving = 0; halving < ENTRY_HALVINGS; ++halving) {
    const float middle = 0.5f * (outside + inside);
    if (depth_inside(s, meshes, start + middle * way, out) > kept) {
      inside = middle;
    } else {
      outside = middle;
    }
  }
  *at = start + inside * way;
  *at += (depth_inside(s, meshes, *at, out) - kept) * *out;
  return true;
}

// Puts a particle that is too deep in body `b`, or came through it, back, and ends its motion into
// the body. `from`: where it was when the step began, `out`: the way it went, `stopped`: by how
// much its speed along that changed [m/s]. False: it is not so deep.
static bool leave_body(constant FluidParams* p, BodyShape shape, global const float* meshes,
                       BodyStep b, float3 from, float3* x, float3* v, float3* out, float* stopped) {
  const float size = size_of(b), kept = KEPT_DEPTH * p->spacing / size;
  const float3 centre = (float3)(b.px, b.py, b.pz), arm = *x - centre;
  const float3 end = rotate_by(arm, -b.qx, -b.qy, -b.qz, b.qw) / size;
  const float3 start = rotate_by(from - centre, -b.qx, -b.qy, -b.qz, b.qw) / size;
  float excess = depth_inside(shape, meshes, end, out) - kept;
  if (!(excess + length(end - start) > 0.0f)) return false;
  float3 entry, side;
  if (!entry_of(shape, meshes, kept, start, end - start, &entry, &side)) return false;
  const float turn = dot(side, *out);
  if (!(excess > 0.0f) && !(turn < 0.0f)) return false;
  if (!(turn > 0.0f)) {
    *x = centre + size * rotate_by(entry, b.qx, b.qy, b.qz, b.qw);
    *out = side;
    excess = 0.0f;
  }
  if (is_mesh(shape)) {
    const float3 at = settled_in_mesh(shape, meshes, kept, excess > 0.0f ? end : entry, out);
    *x = centre + size * rotate_by(at, b.qx, b.qy, b.qz, b.qw);
    excess = 0.0f;
  }
  *out = rotate_by(*out, b.qx, b.qy, b.qz, b.qw);
  *x += size * excess * *out;
  const float3 there = *x - centre;
  const float3 skin = (float3)(b.vx, b.vy, b.vz) + cross((float3)(b.wx, b.wy, b.wz), there) +
                      b.grows / size * there;
  *stopped = -fmin(dot(*v - skin, *out), 0.0f);
  *v += *stopped * *out;
  return true;
}

// Bodies that the water moves have their own stage (body_keep_out.cl): they are pushed back.
static void keep_out(constant FluidParams* p, const Bodies* bodies, float3 from, float3* x,
                     float3* v) {
  for (int k = 0; k < bodies->count; ++k) {
    if (bodies->shapes[k].free) continue;
    float3 out;
    float stopped;
    leave_body(p, bodies->shapes[k], bodies->meshes, bodies->steps[bodies->first + k], from, x, v,
               &out, &stopped);
  }
}

// Lanes whose particles a body may have caught on their way `from` to `x`: where one is deep there
// are points of its around, so its box ends a spacing past these.
static lane_flags may_be_caught(constant FluidParams* p, const Bodies* bodies,
                                const lanes from[3], const lanes x[3]) {
  const float off = p->support - p->spacing;  // the boxes that bodies have reach farther
  lanes low[3], high[3];
  for (int axis = 0; axis < 3; ++axis) {
    low[axis] = fmin(x[axis], from[axis]) + off;
    high[axis] = fmax(x[axis], from[axis]) - off;
  }
  lane_flags caught = 0;
  for (int k = 0; k < bodies->count; ++k) {
    const BodyStep b = bodies->steps[bodies->first + k];
    caught |= (high[0] > (lanes)(b.lower_x)) & (low[0] < (lanes)(b.upper_x)) &
              (high[1] > (lanes)(b.lower_y)) & (low[1] < (lanes)(b.upper_y)) &
              (high[2] > (lanes)(b.lower_z)) & (low[2] < (lanes)(b.upper_z));
  }
  return caught;
}

// Keeps every lane's particle out; most vectors have none near a body. `from`: where they were when
// the step began, `x` and `v`: where they are and how fast.
static void keep_lanes_out(constant FluidParams* p, const Bodies* bodies, const lanes from[3],
                           lanes x[3], lanes v[3]) {
  float3 lower, upper;
  lower.x = least(SMALLER(x[0], from[0]));
  lower.y = least(SMALLER(x[1], from[1]));
  lower.z = least(SMALLER(x[2], from[2]));
  upper.x = most(LARGER(x[0], from[0]));
  upper.y = most(LARGER(x[1], from[1]));
  upper.z = most(LARGER(x[2], from[2]));
  if (!bodies_near_box(bodies->steps, bodies->first, bodies->count, lower, upper)) return;
  const lane_flags caught = may_be_caught(p, bodies, from, x);
  if (!any_lane(caught)) return;
  float before[3][LANES], place[3][LANES], speed[3][LANES];
  int is_caught[LANES];
  STORE(caught, is_caught, 0);
  for (int axis = 0; axis < 3; ++axis) {
    STORE(from[axis], before[axis], 0);
    STORE(x[axis], place[axis], 0);
    STORE(v[axis], speed[axis], 0);
  }
  for (int lane = 0; lane < LANES; ++lane) {
    if (!is_caught[lane]) continue;
    const float3 start = (float3)(before[0][lane], before[1][lane], before[2][lane]);
    float3 at = (float3)(place[0][lane], place[1][lane], place[2][lane]);
    float3 moving = (float3)(speed[0][lane], speed[1][lane], speed[2][lane]);
    keep_out(p, bodies, start, &at, &moving);
    place[0][lane] = at.x;
    place[1][lane] = at.y;
    place[2][lane] = at.z;
    speed[0][lane] = moving.x;
    speed[1][lane] = moving.y;
    speed[2][lane] = moving.z;
  }
  for (int axis = 0; axis < 3; ++axis) {
    x[axis] = LOAD(place[axis], 0);
    v[axis] = LOAD(speed[axis], 0);
  }
}
