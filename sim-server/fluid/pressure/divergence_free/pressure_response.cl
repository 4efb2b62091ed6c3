// SPDX-License-Identifier: MIT
// How a particle's density answers to motion and to its own pressure; the same for all iterations
// of a step. With the gradient of its density by its own place,
//   G_i = sum_j m grad W_ij + rho0 grad f_i + rho0 (gradient of the walls' share),
// density changes at the rate
//   v_i . G_i - sum_j m v_j . grad W_ij + (part of moving bodies and piston),
// and a pressure p_i / rho_i^2 = P_i, which pushes the particle by -P_i G_i and each neighbour by
// +P_i m grad W_ij (pressure/acceleration.cl), changes that rate by -P_i times the response
//   D_i = |G_i|^2 + sum_j |m grad W_ij|^2            Bender & Koschier 2017, eq. 9

#include "sim-server/fluid/boundary/bodies.h"
#include "sim-server/fluid/boundary/body_image.h"
#include "sim-server/fluid/boundary/walls.h"
#include "sim-server/fluid/lanes/lanes.h"
#include "sim-server/fluid/neighbours/group.h"
#include "sim-server/fluid/neighbours/near.h"
#include "sim-server/fluid/neighbours/pair.h"
#include "sim-server/fluid/params/fluid_params.h"
#include "sim-server/fluid/params/smoothing.h"
#include "sim-server/fluid/sleep/sleep.h"

typedef struct {
  lanes x, y, z;  // sum of m grad W, divided by -gradient_norm
  lanes squares;  // of each neighbour's, likewise
} Response;

static Response response_of_fluid(constant FluidParams* p, const Group* g,
                                  global const int* cell_start, global const float* position) {
  Response sum = {0.0f, 0.0f, 0.0f, 0.0f};
  Near near;
  begin_search(&near);
  while (search(p, g, cell_start, position, p->capacity, &near)) {
    for (int k = 0; k < near.count; ++k) {
      const Pair pair = pair_with(p, g, position, p->capacity, NEAR(near, k));
      sum.x += pair.slope * pair.dx;
      sum.y += pair.slope * pair.dy;
      sum.z += pair.slope * pair.dz;
      sum.squares += pair.slope * pair.slope * pair.r2;
    }
  }
  sum.x *= p->mass;
  sum.y *= p->mass;
  sum.z *= p->mass;
  sum.squares *= p->mass * p->mass;
  return sum;
}

// grad f of the bodies, and the rate at which their motion adds to f.
typedef struct {
  lanes gx, gy, gz;  // [1/m]
  lanes rate;        // [1/s]
} BodyResponse;

// What the nearest body's motion, where the particle is, does to R [1/s].
static lanes nearing(const Group* g, global const BodyStep* bodies, int first_body, int body_count,
                     const BodyImage* image) {
  lanes rate = 0.0f;
  for (int k = 0; k < body_count; ++k) {
    const BodyStep b = bodies[first_body + k];
    const lanes x = g->x - b.px, y = g->y - b.py, z = g->z - b.pz;
    const lanes along = image->gx * (b.vx + b.wy * z - b.wz * y) +
                        image->gy * (b.vy + b.wz * x - b.wx * z) +
                        image->gz * (b.vz + b.wx * y - b.wy * x);
    rate = select(rate, along, image->owner == (lanes)(k));
  }
  return rate;
}

// Where a body turns, a point on the line to the particle comes nearer as fast as the body's matter
// does where the particle is: so its points' own speeds serve for R grad S, and the nearest body's
// there for S grad R.
static BodyResponse response_of_bodies(constant FluidParams* p, const Group* g,
                                       const BodyPoints* points, global const BodyStep* bodies,
                                       int first_body, int body_count, BodyImage image) {
  const int n = points->stride;
  BodyShare share = {0.0f, 0.0f, 0.0f, 0.0f};
  lanes carried = 0.0f;
  Near near;
  begin_search(&near);
  while (search(p, g, points->start, points->position, n, &near)) {
    for (int k = 0; k < near.count; ++k) {
      const int j = NEAR(near, k);
      const Pair pair = pair_with(p, g, points->position, n, j);
      add_share(p, &pair, points->volume[j], &share);
      carried += points->volume[j] * pair.slope *
                 (pair.dx * points->velocity[j] + pair.dy * points->velocity[n + j] +
                  pair.dz * points->velocity[2 * n + j]);
    }
  }
  BodyResponse r;
  image_gradient(p, &image, &share, &r.gx, &r.gy, &r.gz);
  r.rate = gradient_norm(p) * image.factor * carried -
           p->kernel_norm * share.share * nearing(g, bodies, first_body, body_count, &image);
  return r;
}

kernel void measure_response(constant FluidParams* p, global const int* cell_start,
                             global const int* activity, global const float* position,
                             global const float* images, global const int* body_start,
                             global const float* body_position, global const float* body_velocity,
                             global const float* body_volume, int body_stride,
                             global const BodyStep* bodies, int first_body, int body_count,
                             float piston, float piston_speed, global float* gradient,
                             global float* response, global float* boundary_rate) {
  const int n = p->capacity;
  const int first = get_global_id(0) * LANES;
  const int last = min(first + LANES, p->count);
  const float scale = -gradient_norm(p);
  lanes gx = 0.0f, gy = 0.0f, gz = 0.0f, d = 0.0f, rate = 0.0f;
  for (int turn = first; turn < last;) {
    const Group g = load_group(p, cell_start, position, first, last, turn);
    if (activity_of(p, activity, &g) < SPLASH_ACTIVITY_MOTION) {
      turn = g.next;
      continue;
    }
    const Response sum = response_of_fluid(p, &g, cell_start, position);
    BodyResponse body = {0.0f, 0.0f, 0.0f, 0.0f};
    if (bodies_near_box(bodies, first_body, body_count, g.lower, g.upper)) {
      const BodyPoints points = {body_start, body_position, body_velocity, body_volume,
                                 body_stride};
      body = response_of_bodies(p, &g, &points, bodies, first_body, body_count,
                                load_image(p, images, first));
    }
    const WallField wall = wall_field(p, g.x, g.y, g.z, piston);
    const lanes x = scale * sum.x + p->rest_density * (wall.gx + body.gx);
    const lanes y = scale * sum.y + p->rest_density * (wall.gy + body.gy);
    const lanes z = scale * sum.z + p->rest_density * (wall.gz + body.gz);
    gx = select(gx, x, g.mine);
    gy = select(gy, y, g.mine);
    gz = select(gz, z, g.mine);
    d = select(d, x * x + y * y + z * z + scale * scale * sum.squares, g.mine);
    rate = select(rate, p->rest_density * (piston_speed * wall.swept + body.rate), g.mine);
    turn = g.next;
  }
  if (first >= last) return;
  STORE(gx, gradient, first);
  STORE(gy, gradient + n, first);
  STORE(gz, gradient + 2 * n, first);
  STORE(d, response, first);
  STORE(rate, boundary_rate, first);
}
