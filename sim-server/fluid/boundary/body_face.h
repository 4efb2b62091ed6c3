// SPDX-License-Identifier: MIT
// Where a body is nearest: its distance, and the outward normal there (outline.h).

#include "sim-server/fluid/boundary/bodies.h"
#include "sim-server/fluid/boundary/outline.h"
#include "sim-server/fluid/lanes/lanes.h"
#include "sim-server/fluid/params/fluid_params.h"

static void turn_lanes(lanes* x, lanes* y, lanes* z, float qx, float qy, float qz, float qw) {
  const lanes tx = 2.0f * (qy * *z - qz * *y);
  const lanes ty = 2.0f * (qz * *x - qx * *z);
  const lanes tz = 2.0f * (qx * *y - qy * *x);
  *x += qw * tx + qy * tz - qz * ty;
  *y += qw * ty + qz * tx - qx * tz;
  *z += qw * tz + qx * ty - qy * tx;
}

// Replaces `nearest` by the face of body number `k` in the lanes where that is nearer.
static void take_nearer(BodyShape shape, global const float* meshes, BodyStep b, int k, lanes x,
                        lanes y, lanes z, BodyFace* nearest) {
  lanes ax = x - b.px, ay = y - b.py, az = z - b.pz;
  turn_lanes(&ax, &ay, &az, -b.qx, -b.qy, -b.qz, b.qw);
  const float size = size_of(b);
  BodyFace face = face_of(shape, meshes, ax / size, ay / size, az / size);
  face.distance *= size;
  turn_lanes(&face.nx, &face.ny, &face.nz, b.qx, b.qy, b.qz, b.qw);
  const lane_flags nearer = face.distance < nearest->distance;
  nearest->distance = select(nearest->distance, face.distance, nearer);
  nearest->nx = select(nearest->nx, face.nx, nearer);
  nearest->ny = select(nearest->ny, face.ny, nearer);
  nearest->nz = select(nearest->nz, face.nz, nearer);
  nearest->owner = select(nearest->owner, (lanes)(k), nearer);
}

// Of all bodies at one step.
static BodyFace nearest_face(constant BodyShape* shapes, global const float* meshes,
                             global const BodyStep* bodies, int first_body, int body_count,
                             lanes x, lanes y, lanes z) {
  BodyFace nearest = {FAR_AWAY, 0.0f, 0.0f, 0.0f, 0.0f};
  for (int k = 0; k < body_count; ++k) {
    take_nearer(shapes[k], meshes, bodies[first_body + k], k, x, y, z, &nearest);
  }
  return nearest;
}

// The same, of those bodies only whose grown bounding boxes overlap the box from `lower` to
// `upper`: all others are farther from any place in it than the support radius.
static BodyFace nearest_face_near(constant BodyShape* shapes, global const float* meshes,
                                  global const BodyStep* bodies, int first_body, int body_count,
                                  float3 lower, float3 upper, lanes x, lanes y, lanes z) {
  BodyFace nearest = {FAR_AWAY, 0.0f, 0.0f, 0.0f, 0.0f};
  for (int k = 0; k < body_count; ++k) {
    global const BodyStep* b = bodies + first_body + k;
    if (is_near_box(b, lower, upper)) take_nearer(shapes[k], meshes, *b, k, x, y, z, &nearest);
  }
  return nearest;
}
