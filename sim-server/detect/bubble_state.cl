// SPDX-License-Identifier: MIT
// Bubbles: carried by the water around them (one way), and what decides whether they live on:
// their own colour field c_b and the upward gradient of all matter (paper, section 4).

#include "sim-server/detect/bubble_state.h"
#include "sim-server/detect/colour.h"
#include "sim-server/fluid/lanes/lanes.h"
#include "sim-server/fluid/neighbours/grid.h"
#include "sim-server/fluid/params/fluid_params.h"
#include "sim-server/fluid/params/smoothing.h"

static float other_bubbles(constant FluidParams* p, global const int* bubble_start,
                           global const float* position, int stride, float x, float y, float z) {
  const int row = cell_row(p, y, z);
  const int slice = slice_x(p, x);
  lanes sum = 0.0f;
  for (int k = 0; k < 9; ++k) {
    const int2 run = neighbour_run(p, bubble_start, row, slice, slice, k);
    for (int j = run.x; j < run.y; j += LANES) {
      const lanes dx = x - load_x(position, j, run.y);
      const lanes dy = y - LOAD(position + stride, j);
      const lanes dz = z - LOAD(position + 2 * stride, j);
      sum += kernel_shape(dx * dx + dy * dy + dz * dz, p->inverse_support);
    }
  }
  return p->kernel_norm * p->mass / p->rest_density * (total(sum) - CENTRE_SHAPE);  // less its own
}

// The water's velocity at a place; (0, 0, 0, 0) far from all water.
static float4 water_velocity(constant FluidParams* p, global const int* cell_start,
                             global const float* position, global const float* velocity, float x,
                             float y, float z) {
  const int n = p->capacity;
  const int row = cell_row(p, y, z);
  const int slice = slice_x(p, x);
  lanes c = 0.0f, u = 0.0f, v = 0.0f, w = 0.0f;
  for (int k = 0; k < 9; ++k) {
    const int2 run = neighbour_run(p, cell_start, row, slice, slice, k);
    for (int j = run.x; j < run.y; j += LANES) {
      const lanes dx = x - load_x(position, j, run.y);
      const lanes dy = y - LOAD(position + n, j);
      const lanes dz = z - LOAD(position + 2 * n, j);
      const lanes weight = kernel_shape(dx * dx + dy * dy + dz * dz, p->inverse_support);
      c += weight;
      u += weight * LOAD(velocity, j);
      v += weight * LOAD(velocity + n, j);
      w += weight * LOAD(velocity + 2 * n, j);
    }
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
  const float4 v = water_velocity(p, cell_start, position, velocity, x, y, z);
  const float upward = upward_gradient(p, cell_start, position, body_start, body_position,
                                       body_volume, body_stride, bodies, first_body, body_count,
                                       bubble_start, bubble_position, bubble_stride, bubble_count,
                                       piston, x, y, z);
  const BubbleState state = {
      other_bubbles(p, bubble_start, bubble_position, bubble_stride, x, y, z), upward,
      x + dt * v.x, y + dt * v.y, z + dt * v.z, bubble_id[i]};
  out[i] = state;
}
