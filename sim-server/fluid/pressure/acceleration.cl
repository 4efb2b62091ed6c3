// SPDX-License-Identifier: MIT
// Acceleration by pressure, viscosity and gravity:
//   a_i = - sum_j m (P_i + P_j) grad W_ij              P = p / rho^2, Monaghan 2005 eq. 3.1
//         + sum_j m K_ij / rho0 (v_ij . x_ij) / (r^2 + eta^2) grad W_ij
//         + g - Omega^2 (x_i - c)                             the scene's pull, along each axis
// with K = 10 nu, and alpha c0 h more for pairs that approach (Monaghan 2005 sections 4 and 5).
// Bodies (body_image.h) and walls (walls.h) push with the particle's own pressure alone,
// -P_i grad rho_i: what the energy of its compression gives (Akinci et al. 2012 eq. 9). Mirroring
// the pressure as well (2 P_i) keeps a little more distance, but is not the gradient of any energy:
// a pool at rest then simmers at 33 mm/s where this form calms to 4. Walls do not rub.
// Particles that sleep are not accelerated, and flagged as not moving.

#include "sim-server/fluid/boundary/bodies.h"
#include "sim-server/fluid/boundary/body_image.h"
#include "sim-server/fluid/boundary/walls.h"
#include "sim-server/fluid/lanes/lanes.h"
#include "sim-server/fluid/neighbours/group.h"
#include "sim-server/fluid/neighbours/near.h"
#include "sim-server/fluid/neighbours/pair.h"
#include "sim-server/fluid/params/fluid_params.h"
#include "sim-server/fluid/params/parts.h"
#include "sim-server/fluid/params/smoothing.h"
#include "sim-server/fluid/sleep/sleep.h"

// What the pair forces need of the particles they act on.
typedef struct {
  lanes u, v, w;  // [m/s]
  lanes own;      // p / rho^2
} Movers;

typedef struct {
  lanes x, y, z;
} Push;

// The viscous part of what one neighbour does, beside P_i + P_j.
static lanes friction(constant FluidParams* p, const Movers* m, const Pair* pair,
                      global const float* velocity, int stride, int j) {
  const float viscous = p->viscous / p->rest_density;
  const float artificial = p->artificial / p->rest_density;
  const lanes closing = closing_with(pair, m->u, m->v, m->w, velocity, stride, j);
  return rubbing(viscous, artificial, closing) * inverse_square(p, pair);
}

// Adds what one neighbour does to the movers, divided by the factor of -grad W; `mass`: the
// neighbour's, `theirs`: its p / rho^2.
static void push(constant FluidParams* p, const Group* g, const Movers* m,
                 global const float* position, global const float* velocity, int stride, int j,
                 float mass, float theirs, Push* sum) {
  const Pair pair = pair_with(p, g, position, stride, j);
  lanes push = m->own + theirs;
  if (HAS_FRICTION) push -= friction(p, m, &pair, velocity, stride, j);
  const lanes f = mass * pair.slope * push;
  sum->x += f * pair.dx;
  sum->y += f * pair.dy;
  sum->z += f * pair.dz;
}

static Push push_by_fluid(constant FluidParams* p, const Group* g, const Movers* movers,
                          global const int* cell_start, global const float* position,
                          global const float* velocity, global const float* pressure_term) {
  Push sum = {0.0f, 0.0f, 0.0f};
  Near near;
  begin_search(&near);
  while (search(p, g, cell_start, position, p->capacity, &near)) {
    for (int k = 0; k < near.count; ++k) {
      const int j = NEAR(near, k);
      push(p, g, movers, position, velocity, p->capacity, j, p->mass, pressure_term[j], &sum);
    }
  }
  return sum;
}

// The share of the bodies, and how they rub on the movers.
static BodyShare rub_by_bodies(constant FluidParams* p, const Group* g, const Movers* movers,
                               const BodyPoints* points, Push* rub) {
  BodyShare share = {0.0f, 0.0f, 0.0f, 0.0f};
  Near near;
  begin_search(&near);
  while (search(p, g, points->start, points->position, points->stride, &near)) {
    for (int k = 0; k < near.count; ++k) {
      const int j = NEAR(near, k);
      const Pair pair = pair_with(p, g, points->position, points->stride, j);
      add_share(p, &pair, points->volume[j], &share);
      if (!HAS_FRICTION) continue;
      const lanes f = p->rest_density * points->volume[j] * pair.slope *
                      friction(p, movers, &pair, points->velocity, points->stride, j);
      rub->x -= f * pair.dx;
      rub->y -= f * pair.dy;
      rub->z -= f * pair.dz;
    }
  }
  return share;
}

// What acts from afar: gravity and the central field.
static Push field_at(constant FluidParams* p, const Group* g) {
  const Push field = {p->gravity_x - p->pull_x * (g->x - p->centre_x),
                      p->gravity_y - p->pull_y * (g->y - p->centre_y),
                      p->gravity_z - p->pull_z * (g->z - p->centre_z)};
  return field;
}

kernel void compute_acceleration(constant FluidParams* p, global const int* cell_start,
                                 global const int* activity, global const int* resting,
                                 global const float* position, global const float* velocity,
                                 global const float* pressure_term, global const float* images,
                                 global const int* body_start, global const float* body_position,
                                 global const float* body_velocity, global const float* body_volume,
                                 int body_stride, global const BodyStep* bodies, int first_body,
                                 int body_count, float piston, global float* acceleration,
                                 global int* moving) {
  const int n = p->capacity;
  const int group = get_global_id(0);
  const int first = group * LANES;
  const int last = min(first + LANES, p->count);
  if (first >= last || resting[group] > 0) return;
  const float gradient = gradient_norm(p);
  Push a = {0.0f, 0.0f, 0.0f};
  lane_flags move = 0;
  for (int turn = first; turn < last;) {
    const Group g = load_group(p, cell_start, position, first, last, turn);
    if (activity_of(p, activity, &g) < SPLASH_ACTIVITY_MOTION) {
      turn = g.next;
      continue;
    }
    move |= g.mine;
    const Movers movers = {LOAD(velocity, first), LOAD(velocity + n, first),
                           LOAD(velocity + 2 * n, first), LOAD(pressure_term, first)};
    Push by = push_by_fluid(p, &g, &movers, cell_start, position, velocity, pressure_term);
    lanes gx = 0.0f, gy = 0.0f, gz = 0.0f;
    if (bodies_near_box(bodies, first_body, body_count, g.lower, g.upper)) {
      const BodyPoints points = {body_start, body_position, body_velocity, body_volume,
                                 body_stride};
      const BodyShare share = rub_by_bodies(p, &g, &movers, &points, &by);
      const BodyImage image = load_image(p, images, first);
      image_gradient(p, &image, &share, &gx, &gy, &gz);
    }
    const WallField wall = wall_field(p, g.x, g.y, g.z, piston);
    const lanes own = movers.own * p->rest_density;
    const Push field = field_at(p, &g);
    a.x = select(a.x, gradient * by.x - own * (wall.gx + gx) + field.x, g.mine);
    a.y = select(a.y, gradient * by.y - own * (wall.gy + gy) + field.y, g.mine);
    a.z = select(a.z, gradient * by.z - own * (wall.gz + gz) + field.z, g.mine);
    turn = g.next;
  }
  STORE(move, moving, first);
  STORE(a.x, acceleration, first);
  STORE(a.y, acceleration + n, first);
  STORE(a.z, acceleration + 2 * n, first);
}
