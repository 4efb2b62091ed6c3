// SPDX-License-Identifier: MIT
// Bodies as kernels see them: how they are turned, and how far they reach.

#include "sim-server/fluid/lanes/lanes.h"
#include "sim-server/fluid/params/fluid_params.h"
#include "sim-server/fluid/params/parts.h"

// The bodies of a step, which are `count` of the frame's `steps` from `first` on, and their looks.
typedef struct {
  constant BodyShape* shapes;
  global const float* meshes;
  global const BodyStep* steps;
  int first, count;
} Bodies;

// Their points, sorted by cells; x, y and z parts `stride` apart.
typedef struct {
  global const int* start;
  global const float* position;
  global const float* velocity;
  global const float* volume;
  int stride;
} BodyPoints;

// `s` turned by the quaternion q.
static float3 rotate_by(float3 s, float qx, float qy, float qz, float qw) {
  const float3 axis = (float3)(qx, qy, qz);
  const float3 t = 2.0f * cross(axis, s);
  return s + qw * t + cross(axis, t);
}

// A body that a tracker puts into the water grows there out of its centre, alike in all
// directions, until it has its size: what it drives away has time to go.
static float size_of(BodyStep b) { return 1.0f - b.lacks; }

// To a body's own axes, and back to the world's.
static float3 into_body(BodyStep b, float3 v) { return rotate_by(v, -b.qx, -b.qy, -b.qz, b.qw); }
static float3 out_of_body(BodyStep b, float3 v) { return rotate_by(v, b.qx, b.qy, b.qz, b.qw); }

// Gives a body this velocity [m/s] and this angular velocity [rad/s].
static void set_speeds(float3 v, float3 w, BodyStep* b) {
  b->vx = v.x;
  b->vy = v.y;
  b->vz = v.z;
  b->wx = w.x;
  b->wy = w.y;
  b->wz = w.z;
}

static BodyStep faster_by(BodyStep b, float3 dv, float3 dw) {
  set_speeds((float3)(b.vx, b.vy, b.vz) + dv, (float3)(b.wx, b.wy, b.wz) + dw, &b);
  return b;
}

// The rotation by a vector of any length, then `b`'s.
static void turn_body(float3 turn, BodyStep* b) {
  const float angle = length(turn);
  const float part = angle > 1.0e-3f ? sin(0.5f * angle) / angle : 0.5f - angle * angle / 48.0f;
  const float4 a = (float4)(part * turn, cos(0.5f * angle));
  const float4 q = (float4)(b->qx, b->qy, b->qz, b->qw);
  float4 r = (float4)(a.w * q.xyz + q.w * a.xyz + cross(a.xyz, q.xyz),
                      a.w * q.w - dot(a.xyz, q.xyz));
  r /= length(r);
  b->qx = r.x;
  b->qy = r.y;
  b->qz = r.z;
  b->qw = r.w;
}

// Whether the bounding box of a body's points, grown by the support radius, overlaps the box from
// `lower` to `upper`.
static bool is_near_box(global const BodyStep* b, float3 lower, float3 upper) {
  return upper.x > b->lower_x && lower.x < b->upper_x && upper.y > b->lower_y &&
         lower.y < b->upper_y && upper.z > b->lower_z && lower.z < b->upper_z;
}

// Whether any body is within reach: most particles are spared the search.
static bool bodies_near_box(global const BodyStep* bodies, int first, int count, float3 lower,
                            float3 upper) {
  if (!HAS_BODIES) return false;
  for (int b = first; b < first + count; ++b) {
    if (is_near_box(bodies + b, lower, upper)) return true;
  }
  return false;
}

// The lanes whose own point lies in the bounding box of a body's points, grown by the support
// radius.
static lane_flags lanes_near_bodies(global const BodyStep* bodies, int first, int count, lanes x,
                                    lanes y, lanes z) {
  lane_flags near = 0;
  for (int k = first; HAS_BODIES && k < first + count; ++k) {
    global const BodyStep* b = bodies + k;
    near |= (x > (lanes)(b->lower_x)) & (x < (lanes)(b->upper_x)) & (y > (lanes)(b->lower_y)) &
            (y < (lanes)(b->upper_y)) & (z > (lanes)(b->lower_z)) & (z < (lanes)(b->upper_z));
  }
  return near;
}

static bool near_bodies(global const BodyStep* bodies, int first, int count, float x, float y,
                        float z) {
  return bodies_near_box(bodies, first, count, (float3)(x, y, z), (float3)(x, y, z));
}

#define CONTACT_POINTS 8  // with which a body meets one wall, at most

// Where an outline is nearest.
typedef struct {
  lanes distance;    // [m], negative inside
  lanes nx, ny, nz;  // its gradient: away from the body
  lanes owner;       // number of the body
} BodyFace;
