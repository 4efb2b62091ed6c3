// SPDX-License-Identifier: MIT
// A fluid particle entraps air while it is fast and has most of the matter above it (paper,
// section 4). It spawns a bubble particle once: again only after either has ceased.

#include "sim-server/detect/bubble_state.h"
#include "sim-server/detect/colour.h"
#include "sim-server/fluid/params/fluid_params.h"

// `memory`: of each particle by id, its last upward gradient, or what it is instead.
kernel void spawn_bubbles(constant FluidParams* p, global const int* cell_start,
                          global const float* position, global const float* velocity,
                          global const int* id, global const int* body_start,
                          global const float* body_position, global const float* body_volume,
                          int body_stride, global const BodyStep* bodies, int first_body,
                          int body_count, global const int* bubble_start,
                          global const float* bubble_position, int bubble_stride,
                          int bubble_count, float piston, float least_speed,
                          float least_gradient, int room, global float* memory,
                          global Spawn* out) {
  const int i = get_global_id(0);
  if (i >= p->count) return;
  const int n = p->capacity;
  const float u = velocity[i], v = velocity[n + i], w = velocity[2 * n + i];
  if (u * u + v * v + w * w < least_speed * least_speed) {
    memory[id[i]] = SPLASH_PARTICLE_SLOW;
    return;
  }
  const float x = position[i], y = position[n + i], z = position[2 * n + i];
  const Matter matter = {{cell_start, position, p->capacity},
                         {body_start, body_position, body_stride},
                         {bubble_start, bubble_position, bubble_stride},
                         body_volume,
                         bubble_count,
                         bodies,
                         first_body,
                         body_count};
  const float now = upward_gradient(p, &matter, piston, x, y, z);
  const float last = memory[id[i]];
  if (now <= least_gradient) {
    // Spent particles must lose the upward gradient altogether before they may spawn again.
    memory[id[i]] = last == SPLASH_PARTICLE_SPENT && now > 0.0f ? SPLASH_PARTICLE_SPENT : now;
    return;
  }
  memory[id[i]] = SPLASH_PARTICLE_SPENT;
  if (last == SPLASH_PARTICLE_SPENT) return;
  const int place = atomic_inc(&out->id);  // of the first entry: how many follow
  if (place >= room) return;
  const bool known = last != SPLASH_PARTICLE_SLOW;
  const float before = known ? (least_gradient - last) / (now - last) : -1.0f;
  const Spawn spawn = {id[i], x, y, z, before};
  out[1 + place] = spawn;
}
