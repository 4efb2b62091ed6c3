// SPDX-License-Identifier: MIT
// The vertical part of the colour field's gradient over all matter: fluid, bodies, bubbles and
// walls (paper, eq. 2). Positive: most of the matter around is above.

#include "sim-server/fluid/boundary/bodies.h"
#include "sim-server/fluid/boundary/walls.h"
#include "sim-server/fluid/lanes/lanes.h"
#include "sim-server/fluid/neighbours/around.h"
#include "sim-server/fluid/params/fluid_params.h"
#include "sim-server/fluid/params/smoothing.h"

// All matter of a scene but its walls.
typedef struct {
  Cloud water, body, bubbles;
  global const float* body_volume;  // of each of the bodies' points [m3]
  int bubble_count;
  global const BodyStep* bodies;  // of this step
  int first_body, body_count;
} Matter;

// Sum of slope (z_j - z) over one kind of point, all alike.
static float matter_above(constant FluidParams* p, const Cloud* points, float x, float y,
                          float z) {
  lanes sum = 0.0f;
  for (Around a = around(p, x, y, z); next_around(p, points, &a);) {
    sum -= kernel_slope(square_of(&a), p->inverse_support) * a.dz;
  }
  return total(sum);
}

static float body_above(constant FluidParams* p, const Matter* matter, float x, float y,
                        float z) {
  lanes sum = 0.0f;
  for (Around a = around(p, x, y, z); next_around(p, &matter->body, &a);) {
    const lanes slope = kernel_slope(square_of(&a), p->inverse_support);
    sum -= LOAD(matter->body_volume, a.j) * slope * a.dz;
  }
  return total(sum);
}

// All of it, in units of the gradient at a flat surface.
static float upward_gradient(constant FluidParams* p, const Matter* matter, float piston, float x,
                             float y, float z) {
  const float volume = p->mass / p->rest_density;
  float sum = volume * matter_above(p, &matter->water, x, y, z);
  if (matter->bubble_count > 0) sum += volume * matter_above(p, &matter->bubbles, x, y, z);
  if (near_bodies(matter->bodies, matter->first_body, matter->body_count, x, y, z)) {
    sum += body_above(p, matter, x, y, z);
  }
  const float gradient = gradient_norm(p) * sum +
                         first_lane(wall_field(p, (lanes)(x), (lanes)(y), (lanes)(z), piston).gz);
  return gradient * p->support / PLANE_PEAK;
}
