// SPDX-License-Identifier: MIT
// Symplectic Euler: v += a dt, x += v dt. Then nobody is left behind a wall, and nobody outruns
// the speed limit.

kernel void integrate(constant FluidParams* p, float dt, float piston, float piston_speed,
                      global const float* acceleration, global float* position,
                      global float* velocity) {
  const int i = get_global_id(0);
  if (i >= p->count) return;
  const int n = p->capacity;
  float3 v = (float3)(velocity[i], velocity[n + i], velocity[2 * n + i]) +
             dt * (float3)(acceleration[i], acceleration[n + i], acceleration[2 * n + i]);
  const float speed = length(v);
  if (speed > p->speed_limit) v *= p->speed_limit / speed;
  float3 x = (float3)(position[i], position[n + i], position[2 * n + i]) + dt * v;

  const float least = 0.05f * p->spacing;
  for (int k = 0; k < p->wall_count; ++k) {
    const float d = wall_distance(p, k, x.x, x.y, x.z, piston);
    if (d >= least) continue;
    const float3 normal = (float3)(p->walls[k].nx, p->walls[k].ny, p->walls[k].nz);
    x += (least - d) * normal;
    const float into = dot(v, normal) - (k == p->piston ? piston_speed : 0.0f);
    v -= fmin(into, 0.0f) * normal;
  }
  position[i] = x.x;
  position[n + i] = x.y;
  position[2 * n + i] = x.z;
  velocity[i] = v.x;
  velocity[n + i] = v.y;
  velocity[2 * n + i] = v.z;
}
