// SPDX-License-Identifier: MIT
// A fluid particle entraps air while it is fast and has most of the matter above it (paper,
// section 4). It spawns a bubble particle once: again only after either has ceased.

#include "sim-server/detect/colour.h"
#include "sim-server/fluid/params/fluid_params.h"

typedef struct {
  int id;                // of the particle
  float x, y, z;         // [m]
  float u, v, w;         // [m/s]
  float before;          // part of the frame that had passed when the threshold was crossed; below
                         // zero: not known
  int fresh;             // it has just begun to entrap air: a bubble particle is spawned
  int dense;             // it belongs to a body of water, and is not spray
} Spawn;

// `memory`: of each particle by id, its last upward gradient; kSlow: it was slow, kSpent: it has
// spawned and not calmed down since.
#define SLOW -8.0f
#define SPENT 8.0f

kernel void spawn_bubbles(constant FluidParams* p, global const int* cell_start,
                          global const float* position, global const float* velocity,
                          global const float* density, global const int* id,
                          global const int* body_start,
                          global const float* body_position, global const float* body_volume,
                          int body_stride, global const BodyStep* bodies, int first_body,
                          int body_count, global const int* bubble_start,
                          global const float* bubble_position, int bubble_stride,
                          int bubble_count, float piston, float least_speed,
                          float least_gradient, int room, global float* memory,
                          global int* counts, global Spawn* out) {
  const int i = get_global_id(0);
  if (i >= p->count) return;
  const int n = p->capacity;
  const float u = velocity[i], v = velocity[n + i], w = velocity[2 * n + i];
  if (u * u + v * v + w * w < least_speed * least_speed) {
    memory[id[i]] = SLOW;
    return;
  }
  const float x = position[i], y = position[n + i], z = position[2 * n + i];
  const float now = upward_gradient(p, cell_start, position, body_start, body_position,
                                    body_volume, body_stride, bodies, first_body, body_count,
                                    bubble_start, bubble_position, bubble_stride, bubble_count,
                                    piston, x, y, z);
  const float last = memory[id[i]];
  if (now <= least_gradient) {
    // Spent particles must lose the upward gradient altogether before they may spawn again.
    memory[id[i]] = last == SPENT && now > 0.0f ? SPENT : now;
    return;
  }
  memory[id[i]] = SPENT;
  const int fresh = last != SPENT;
  const int dense = density[i] >= p->least_density;
  if (!fresh && !dense) return;
  const int place = atomic_inc(counts);
  if (place >= room) return;
  const float before = last == SLOW || !fresh ? -1.0f : (least_gradient - last) / (now - last);
  const Spawn spawn = {id[i], x, y, z, u, v, w, before, fresh, dense};
  out[place] = spawn;
}
