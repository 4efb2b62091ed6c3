// SPDX-License-Identifier: MIT
// Symplectic Euler: v += a dt, x += v dt. Then nobody is left behind a wall, and nobody outruns
// the speed limit; nobody is caught in a body or goes through it. Sleeping particles stay where
// they are, and keep their speed for when they wake.

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
  lanes u = LOAD(velocity, i) + dt * LOAD(acceleration, i);
  lanes v = LOAD(velocity + n, i) + dt * LOAD(acceleration + n, i);
  lanes w = LOAD(velocity + 2 * n, i) + dt * LOAD(acceleration + 2 * n, i);
  const lanes slower = fmin(p->speed_limit * rsqrt(u * u + v * v + w * w), 1.0f);
  u *= slower;
  v *= slower;
  w *= slower;
  const lanes a = LOAD(position, i), b = LOAD(position + n, i), c = LOAD(position + 2 * n, i);
  lanes x = a + dt * u;
  lanes y = b + dt * v;
  lanes z = c + dt * w;
  keep_lanes_out(p, shapes, meshes, bodies, first_body, body_count, a, b, c, &x, &y, &z, &u, &v,
                 &w);

  keep_in_tank(p, piston, piston_speed, &x, &y, &z, &u, &v, &w);
  STORE(select(a, x, move), position, i);
  STORE(select(b, y, move), position + n, i);
  STORE(select(c, z, move), position + 2 * n, i);
  STORE(select(LOAD(velocity, i), u, move), velocity, i);
  STORE(select(LOAD(velocity + n, i), v, move), velocity + n, i);
  STORE(select(LOAD(velocity + 2 * n, i), w, move), velocity + 2 * n, i);
}
