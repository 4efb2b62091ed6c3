// SPDX-License-Identifier: MIT
// Density by summation over fluid, bodies (as the frozen fluid they displace, Akinci et al. 2012)
// and walls:
//   rho_i = sum_j m W_ij + rho0 f_i + rho0 (share of the kernel inside walls)
//   f_i   = R_i sum_b V_b W_ib                                                   body_image.h
// and pressure from it by the weakly compressible state equation (state_equation.h). The force
// needs p / rho^2 only, so that is what is stored. The part without bodies is kept, too: it tells
// water from the film that a body carries along. Where the water sleeps, and away from bodies in
// steps that do not ask for them `everywhere`, all of them are what they were before the sort.

#include "sim-server/fluid/boundary/bodies.h"
#include "sim-server/fluid/boundary/body_face.h"
#include "sim-server/fluid/boundary/body_image.h"
#include "sim-server/fluid/boundary/walls.h"
#include "sim-server/fluid/lanes/lanes.h"
#include "sim-server/fluid/neighbours/group.h"
#include "sim-server/fluid/neighbours/near.h"
#include "sim-server/fluid/params/fluid_params.h"
#include "sim-server/fluid/params/smoothing.h"
#include "sim-server/fluid/pressure/state_equation.h"
#include "sim-server/fluid/sleep/rest.h"
#include "sim-server/fluid/sleep/sleep.h"

static lanes shape_at(constant FluidParams* p, const Group* g, global const float* position,
                      int stride, int j) {
  const lanes dx = g->x - position[j];
  const lanes dy = g->y - position[stride + j];
  const lanes dz = g->z - position[2 * stride + j];
  return kernel_shape(dx * dx + dy * dy + dz * dz, p->inverse_support);
}

// Sum of W / sigma over the fluid around each lane.
static lanes sum_fluid(constant FluidParams* p, const Group* g, global const int* cell_start,
                       global const float* position) {
  lanes sum = 0.0f;
  Near near;
  begin_search(&near);
  while (search(p, g, cell_start, position, p->capacity, &near)) {
    for (int k = 0; k < near.count; ++k) {
      sum += shape_at(p, g, position, p->capacity, NEAR(near, k));
    }
  }
  return sum;
}

// Sum of V_b W / sigma over the body points around each lane.
static lanes sum_bodies(constant FluidParams* p, const Group* g, global const int* body_start,
                        global const float* body_position, global const float* body_volume,
                        int stride) {
  lanes sum = 0.0f;
  Near near;
  begin_search(&near);
  while (search(p, g, body_start, body_position, stride, &near)) {
    for (int k = 0; k < near.count; ++k) {
      const int j = NEAR(near, k);
      sum += body_volume[j] * shape_at(p, g, body_position, stride, j);
    }
  }
  return sum;
}

// The densities of a step: of all matter, without the bodies' part, and the peak
// (state_equation.h).
typedef struct {
  global float* density;
  global float* water;
  global float* peak;
} Densities;

// The same of the step before, as it was before the sort.
typedef struct {
  global const float* density;
  global const float* water;
  global const float* peak;
} DensitiesBefore;

// A group that rests has what it had, wherever the sort put it, and nothing moves it.
static void keep_resting(constant FluidParams* p, global const int* source, int first, int last,
                         const DensitiesBefore* before, const Densities* now,
                         global float* pressure_term, global float* acceleration,
                         global int* moving) {
  const lanes rho = kept(before->density, source, first, last);
  const lanes k = kept(before->peak, source, first, last);
  const lanes none = 0.0f;
  const lane_flags still = 0;
  STORE(rho, now->density, first);
  STORE(kept(before->water, source, first, last), now->water, first);
  STORE(k, now->peak, first);
  STORE(state_equation(p, rho, k), pressure_term, first);
  STORE(still, moving, first);
  for (int axis = 0; axis < 3; ++axis) STORE(none, acceleration + axis * p->capacity, first);
}

kernel void compute_density(
    constant FluidParams* p, global const int* cell_start, global const int* activity,
    global const int* source, global const float* density_before,
    global const float* water_density_before, global const float* peak_before,
    global const float* position, global const int* body_start, global const float* body_position,
    global const float* body_volume, int body_stride, constant BodyShape* shapes,
    global const float* meshes, global const BodyStep* bodies, int first_body, int body_count,
    float dt, int everywhere, float piston, global float* images, global float* density,
    global float* water_density, global float* peak, global float* pressure_term,
    global float* acceleration, global int* moving, global int* resting) {
  const int group = get_global_id(0);
  const int first = group * LANES;
  const int last = min(first + LANES, p->count);
  if (first >= last) return;
  resting[group] = rested(p, cell_start, activity, source, position, bodies, first_body, body_count,
                          resting[group], first, last);
  if (resting[group] > 0) {
    if (resting[group] == RESTED) return;
    const DensitiesBefore before = {density_before, water_density_before, peak_before};
    const Densities now = {density, water_density, peak};
    keep_resting(p, source, first, last, &before, &now, pressure_term, acceleration, moving);
    return;
  }
  lanes water = p->rest_density, rho = p->rest_density;
  BodyImage images_here = no_image();
  bool any_near = false;
  for (int turn = first; turn < last;) {
    const Group g = load_group(p, cell_start, position, first, last, turn);
    const bool near = bodies_near_box(bodies, first_body, body_count, g.lower, g.upper);
    BodyImage image = no_image();
    if (near) {
      const BodyFace face =
          nearest_face(shapes, meshes, bodies, first_body, body_count, g.x, g.y, g.z);
      image = image_before(p, &face);
      choose_image(&images_here, &image, g.mine);
      any_near = true;
    }
    lane_flags asked = g.mine;
    const bool asleep = activity_of(p, activity, &g) < SPLASH_ACTIVITY_DENSITY;
    if (asleep || !everywhere) {
      water = select(water, kept(water_density_before, source, first, last), g.mine);
      rho = select(rho, kept(density_before, source, first, last), g.mine);
      asked &= lanes_near_bodies(bodies, first_body, body_count, g.x, g.y, g.z);
    }
    if (asleep || !any_lane(asked)) {
      turn = g.next;
      continue;
    }
    const lanes share = wall_field(p, g.x, g.y, g.z, piston).share;
    const lanes fluid =
        p->kernel_norm * p->mass * sum_fluid(p, &g, cell_start, position) + p->rest_density * share;
    lanes all = fluid;
    if (near) {
      const lanes bodies_share =
          p->kernel_norm * sum_bodies(p, &g, body_start, body_position, body_volume, body_stride);
      all += p->rest_density * image.factor * bodies_share;
    }
    water = select(water, fluid, asked);
    rho = select(rho, all, asked);
    turn = g.next;
  }
  if (any_near) store_image(p, &images_here, first, images);
  STORE(rho, density, first);
  STORE(water, water_density, first);
  const lanes k = peak_density_now(p, dt, rho, kept(peak_before, source, first, last));
  STORE(k, peak, first);
  STORE(state_equation(p, rho, k), pressure_term, first);
}
