// SPDX-License-Identifier: MIT
// Which particles a free body reaches, and what they do to each other (body_reach.h):
//   g_i = rho0 (R sum_b V_b grad W_ib + S grad R, if the body is the nearest)     body_image.h
//   a_i = sum_b V_b K_ib (v_ib . x_ib) / (r^2 + eta^2) grad W_ib
//   c_i = dt sum_b V_b K |grad W_ib| r / (r^2 + eta^2),  the most that rubbing can yield
// the same terms as in acceleration.cl (pair.h), of this body's points alone.

#include "sim-server/fluid/boundary/bodies.h"
#include "sim-server/fluid/boundary/body_image.h"
#include "sim-server/fluid/free_bodies/body_reach.h"
#include "sim-server/fluid/lanes/lanes.h"
#include "sim-server/fluid/neighbours/group.h"
#include "sim-server/fluid/neighbours/near.h"
#include "sim-server/fluid/neighbours/pair.h"
#include "sim-server/fluid/params/fluid_params.h"
#include "sim-server/fluid/params/smoothing.h"

static void reach_of_group(constant FluidParams* p, const Group* g, global const float* velocity,
                           int first, const BodyPoints* points, global const int* body_id,
                           global const int* owner, int body, BodyImage image, Reach* sum) {
  const int n = p->capacity;
  const lanes u = LOAD(velocity, first), v = LOAD(velocity + n, first),
              w = LOAD(velocity + 2 * n, first);
  BodyShare share = {0.0f, 0.0f, 0.0f, 0.0f};
  lanes all = 0.0f;  // the share of all bodies
  Near near;
  begin_search(&near);
  while (search(p, g, points->start, points->position, points->stride, &near)) {
    for (int k = 0; k < near.count; ++k) {
      const int j = NEAR(near, k);
      const Pair pair = pair_with(p, g, points->position, points->stride, j);
      all += points->volume[j] * kernel_shape(pair.r2, p->inverse_support);
      if (owner[body_id[j]] != body) continue;
      add_share(p, &pair, points->volume[j], &share);
      const lanes closing = closing_with(&pair, u, v, w, points->velocity, points->stride, j);
      const lanes steep = points->volume[j] * pair.slope;
      const lanes near2 = inverse_square(p, &pair);
      const lanes rub = steep * near2 * rubbing(p->viscous, p->artificial, closing);
      sum->ax += rub * pair.dx;
      sum->ay += rub * pair.dy;
      sum->az += rub * pair.dz;
      sum->rub += steep * near2 * (p->viscous + p->artificial) * pair.r2;
    }
  }
  share.share = select((lanes)(0.0f), all, image.owner == (lanes)(body));
  image_gradient(p, &image, &share, &sum->gx, &sum->gy, &sum->gz);
}

// b_i; particles without pressure, which attract none, do not yield to the state equation.
static lanes yield_of(constant FluidParams* p, float dt, global const float* pressure_term,
                      global const float* density, int first) {
  const lanes term = LOAD(pressure_term, first);
  const lanes way = p->sound_speed * dt / LOAD(density, first);
  const float stretched = p->sound_speed * dt / p->rest_density;
  const lanes yield = select((lanes)(0.0f), way * way, term > 0.0f);
  return select(yield, (lanes)(SPLASH_STRETCH_STIFFNESS * stretched * stretched), term < 0.0f);
}

static void finish_reach(constant FluidParams* p, float dt, lanes yield, Reach* r) {
  const float gradient = gradient_norm(p);
  r->gx *= p->rest_density;
  r->gy *= p->rest_density;
  r->gz *= p->rest_density;
  r->ax *= -gradient;
  r->ay *= -gradient;
  r->az *= -gradient;
  r->rub *= gradient * dt;
  const lanes g2 = r->gx * r->gx + r->gy * r->gy + r->gz * r->gz;
  r->yield = select((lanes)(0.0f), yield, g2 > 0.0f);
}

// One work-item for each free body and group of particles. `reached`: of each of them, whether the
// body is near; what is not reached is not written.
kernel void reach_bodies(constant FluidParams* p, float dt, int free_count,
                         constant FreeBody* frees, global const BodyStep* bodies, int first_body,
                         global const int* cell_start, global const float* position,
                         global const float* velocity, global const float* density,
                         global const float* images, global const float* pressure_term,
                         global const int* body_start, global const float* body_position,
                         global const float* body_velocity, global const float* body_volume,
                         global const int* body_id, global const int* owner, int body_stride,
                         global float* reach, global int* reached) {
  const int item = get_global_id(0);
  if (item >= free_count * group_count(p)) return;
  const int k = item / group_count(p);
  const int first = item % group_count(p) * LANES;
  const int last = min(first + LANES, p->count);
  const BodyPoints points = {body_start, body_position, body_velocity, body_volume, body_stride};
  Reach all = {0.0f, 0.0f, 0.0f, 0.0f, 0.0f, 0.0f, 0.0f, 0.0f};
  int near = 0;
  for (int turn = first; turn < last;) {
    const Group g = load_group(p, cell_start, position, first, last, turn);
    turn = g.next;
    if (!bodies_near_box(bodies, first_body + frees[k].body, 1, g.lower, g.upper)) continue;
    near = 1;
    Reach one = {0.0f, 0.0f, 0.0f, 0.0f, 0.0f, 0.0f, 0.0f, 0.0f};
    reach_of_group(p, &g, velocity, first, &points, body_id, owner, frees[k].body,
                   load_image(p, images, first), &one);
    all.gx = select(all.gx, one.gx, g.mine);
    all.gy = select(all.gy, one.gy, g.mine);
    all.gz = select(all.gz, one.gz, g.mine);
    all.ax = select(all.ax, one.ax, g.mine);
    all.ay = select(all.ay, one.ay, g.mine);
    all.az = select(all.az, one.az, g.mine);
    all.rub = select(all.rub, one.rub, g.mine);
  }
  reached[item] = near;
  if (!near) return;
  finish_reach(p, dt, yield_of(p, dt, pressure_term, density, first), &all);
  store_reach(p, reach, k, first, &all);
}
