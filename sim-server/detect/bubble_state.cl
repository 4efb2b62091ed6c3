// SPDX-License-Identifier: MIT
// Bubbles: carried by the water around them (one way), and what decides whether they live on:
// their own colour field c_b and the upward gradient of all matter (paper, section 4).

#include "sim-server/detect/bubble_state.h"
#include "sim-server/detect/colour.h"
#include "sim-server/fluid/lanes/lanes.h"
#include "sim-server/fluid/neighbours/around.h"
#include "sim-server/fluid/params/fluid_params.h"
#include "sim-server/fluid/params/smoothing.h"

static float other_bubbles(constant FluidParams* p, const Cloud* bubbles, float x, float y,
                           float z) {
  lanes sum = 0.0f;
  for (Around a = around(p, x, y, z); next_around(p, bubbles, &a);) {
    sum += kernel_shape(square_of(&a), p->inverse_support);
  }
  return p->kernel_norm * p->mass / p->rest_density * (total(sum) - CENTRE_SHAPE);  // less its own
}

// The water's velocity at a place; (0, 0, 0, 0) far from all water.
static float4 water_velocity(constant FluidParams* p, const Cloud* water,
                             global const float* velocity, float x, float y, float z) {
  const int n = p->capacity;
  lanes c = 0.0f, u = 0.0f, v = 0.0f, w = 0.0f;
  for (Around a = around(p, x, y, z); next_around(p, water, &a);) {
    const lanes weight = kernel_shape(square_of(&a), p->inverse_support);
    c += weight;
    u += weight * LOAD(velocity, a.j);
    v += weight * LOAD(velocity + n, a.j);
    w += weight * LOAD(velocity + 2 * n, a.j);
  }
  const float share = 1.0f / fmax(total(c), FLT_MIN);  // a weight is 1e-15 just inside the support
  return (float4)(share * total(u), share * total(v), share * total(w), 0.0f);
}

kernel void carry_bubbles(constant FluidParams* p, float dt, global const int* cell_start,
                          global const float* position, global const float* velocity,
                          global const int* body_start, global const float* body_position,
                          global const float* body_volume, int body_stride,
                          global const BodyStep* bodies, int first_body, int body_count,
                          global const int* bubble_start, global const float* bubble_position,
                          global const int* bubble_id, int bubble_stride, int bubble_count,
                          float piston, global BubbleState* out) {
  const int i = get_global_id(0);
  if (i >= bubble_count) return;
  const float x = bubble_position[i];
  const float y = bubble_position[bubble_stride + i];
  const float z = bubble_position[2 * bubble_stride + i];
  const Matter matter = {{cell_start, position, p->capacity},
                         {body_start, body_position, body_stride},
                         {bubble_start, bubble_position, bubble_stride},
                         body_volume,
                         bubble_count,
                         bodies,
                         first_body,
                         body_count};
  const float4 v = water_velocity(p, &matter.water, velocity, x, y, z);
  const float upward = upward_gradient(p, &matter, piston, x, y, z);
  const BubbleState state = {other_bubbles(p, &matter.bubbles, x, y, z), upward,
                             x + dt * v.x, y + dt * v.y, z + dt * v.z, bubble_id[i]};
  out[i] = state;
}
