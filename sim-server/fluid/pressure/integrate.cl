// SPDX-License-Identifier: MIT
// Symplectic Euler: v += a dt, x += v dt. Speeds are held under the limit, and particles in front
// of walls and out of bodies. Sleeping particles stay where they are, and keep their velocity for
// when they wake.

#include "sim-server/fluid/boundary/walls.h"
#include "sim-server/fluid/boundary/keep_out.h"
#include "sim-server/fluid/lanes/lanes.h"
#include "sim-server/fluid/params/fluid_params.h"

kernel void integrate(constant FluidParams* p, float dt, float piston, float piston_speed,
                      constant BodyShape* shapes, global const float* meshes,
                      global const BodyStep* bodies, int first_body, int body_count,
                      global const float* acceleration, global float* position,
                      global float* velocity, global const int* moving,
                      global const int* resting) {
  const int group = get_global_id(0);
  const int i = group * LANES;
  if (i >= p->count || resting[group] > 0) return;
  const lane_flags move = LOAD(moving, i) != 0;
  if (!any_lane(move)) return;
  const int n = p->capacity;
  lanes from[3], x[3], v[3];
  for (int axis = 0; axis < 3; ++axis) {
    v[axis] = LOAD(velocity + axis * n, i) + dt * LOAD(acceleration + axis * n, i);
  }
  const lanes slower =
      fmin(p->speed_limit * rsqrt(v[0] * v[0] + v[1] * v[1] + v[2] * v[2]), 1.0f);
  for (int axis = 0; axis < 3; ++axis) {
    v[axis] *= slower;
    from[axis] = LOAD(position + axis * n, i);
    x[axis] = from[axis] + dt * v[axis];
  }
  const Bodies near = {shapes, meshes, bodies, first_body, body_count};
  keep_lanes_out(p, &near, from, x, v);
  keep_in_tank(p, piston, piston_speed, &x[0], &x[1], &x[2], &v[0], &v[1], &v[2]);
  for (int axis = 0; axis < 3; ++axis) {
    STORE(select(from[axis], x[axis], move), position + axis * n, i);
    STORE(select(LOAD(velocity + axis * n, i), v[axis], move), velocity + axis * n, i);
  }
}
