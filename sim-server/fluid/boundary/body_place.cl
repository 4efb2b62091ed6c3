// SPDX-License-Identifier: MIT
// Rigid bodies: their points carried to where the body is in this step.
//   x = c + R s,   v = u + w x (R s)
// Those that grow (bodies.h) have their points as much nearer to the centre, and smaller.

#include "sim-server/fluid/boundary/bodies.h"
#include "sim-server/fluid/params/fluid_params.h"

// `sample`: points in body axes; `owner`: which body each belongs to; `bodies`: one entry per body
// of this step.
kernel void place_bodies(int points, int stride, global const float* sample,
                         global const int* owner, global const BodyStep* bodies, int first_body,
                         global float* position, global float* velocity) {
  const int i = get_global_id(0);
  if (i >= points) return;
  const BodyStep b = bodies[first_body + owner[i]];
  const float3 s =
      size_of(b) * (float3)(sample[i], sample[stride + i], sample[2 * stride + i]);
  const float3 arm = rotate_by(s, b.qx, b.qy, b.qz, b.qw);
  const float3 x = (float3)(b.px, b.py, b.pz) + arm;
  const float3 v = (float3)(b.vx, b.vy, b.vz) + cross((float3)(b.wx, b.wy, b.wz), arm) +
                   b.grows / size_of(b) * arm;
  position[i] = x.x;
  position[stride + i] = x.y;
  position[2 * stride + i] = x.z;
  velocity[i] = v.x;
  velocity[stride + i] = v.y;
  velocity[2 * stride + i] = v.z;
}

// Volumes in the order of the sorted points; `id`: sorted, counts the samples.
kernel void gather_body_volumes(int points, global const int* id, global const float* volume,
                                global const int* owner, global const BodyStep* bodies,
                                int first_body, global float* sorted_volume) {
  const int i = get_global_id(0);
  if (i >= points) return;
  const float size = size_of(bodies[first_body + owner[id[i]]]);
  sorted_volume[i] = size * size * size * volume[id[i]];
}
