// SPDX-License-Identifier: MIT
// The vertical part of the colour field's gradient over all matter: fluid, bodies, bubbles and
// walls (paper, eq. 2). Positive: most of the matter around is above.

#include "sim-server/fluid/boundary/bodies.h"
#include "sim-server/fluid/boundary/walls.h"
#include "sim-server/fluid/lanes/lanes.h"
#include "sim-server/fluid/neighbours/grid.h"
#include "sim-server/fluid/params/fluid_params.h"
#include "sim-server/fluid/params/smoothing.h"

// Sum of slope (z_j - z) over one kind of point; with a volume each, or all alike.
static float matter_above(constant FluidParams* p, global const int* cell_start,
                          global const float* position, int stride, float x, float y, float z) {
  const int row = cell_row(p, y, z);
  const int slice = slice_x(p, x);
  lanes sum = 0.0f;
  for (int k = 0; k < 9; ++k) {
    const int2 run = neighbour_run(p, cell_start, row, slice, slice, k);
    for (int j = run.x; j < run.y; j += LANES) {
      const lanes dx = x - load_x(position, j, run.y);
      const lanes dy = y - LOAD(position + stride, j);
      const lanes dz = z - LOAD(position + 2 * stride, j);
      sum -= kernel_slope(dx * dx + dy * dy + dz * dz, p->inverse_support) * dz;
    }
  }
  return total(sum);
}

static float body_above(constant FluidParams* p, global const int* body_start,
                        global const float* body_position, global const float* body_volume,
                        int stride, float x, float y, float z) {
  const int row = cell_row(p, y, z);
  const int slice = slice_x(p, x);
  lanes sum = 0.0f;
  for (int k = 0; k < 9; ++k) {
    const int2 run = neighbour_run(p, body_start, row, slice, slice, k);
    for (int j = run.x; j < run.y; j += LANES) {
      const lanes dx = x - load_x(body_position, j, run.y);
      const lanes dy = y - LOAD(body_position + stride, j);
      const lanes dz = z - LOAD(body_position + 2 * stride, j);
      const lanes slope = kernel_slope(dx * dx + dy * dy + dz * dz, p->inverse_support);
      sum -= LOAD(body_volume, j) * slope * dz;
    }
  }
  return total(sum);
}

// All of it, in units of the gradient at a flat surface.
static float upward_gradient(constant FluidParams* p, global const int* cell_start,
                             global const float* position, global const int* body_start,
                             global const float* body_position, global const float* body_volume,
                             int body_stride, global const BodyStep* bodies, int first_body,
                             int body_count, global const int* bubble_start,
                             global const float* bubble_position, int bubble_stride,
                             int bubble_count, float piston, float x, float y, float z) {
  const float volume = p->mass / p->rest_density;
  float sum = volume * matter_above(p, cell_start, position, p->capacity, x, y, z);
  if (bubble_count > 0) {
    sum += volume * matter_above(p, bubble_start, bubble_position, bubble_stride, x, y, z);
  }
  if (near_bodies(bodies, first_body, body_count, x, y, z)) {
    sum += body_above(p, body_start, body_position, body_volume, body_stride, x, y, z);
  }
  const float gradient = gradient_norm(p) * sum +
                         first_lane(wall_field(p, (lanes)(x), (lanes)(y), (lanes)(z), piston).gz);
  return gradient * p->support / PLANE_PEAK;
}
