// SPDX-License-Identifier: MIT
// How free bodies answer to the water, and the water to them (body_reach.h):
//   (M + sum_i m J_i^T B_i J_i) (dV, dw) = M g dt + sum_i m J_i^T (s_i g_i - dt a_i)
//   dv_i = B_i (dV + dw x (x_i - c)),   B_i = b_i g_i g_i^T + c_i 1
// with s_i = dt P_i; a body that hangs on a device is pulled by its spring, too (body_spring.h).
// Spins are solved for as speeds at a lever, so that all six equations are of one unit. Sums have a
// fixed order: the same state gives the same bits.

#include "sim-server/fluid/boundary/body_inertia.h"
#include "sim-server/fluid/boundary/six.h"
#include "sim-server/fluid/free_bodies/body_reach.h"
#include "sim-server/fluid/boundary/body_spring.h"
#include "sim-server/fluid/lanes/lanes.h"
#include "sim-server/fluid/lanes/team.h"
#include "sim-server/fluid/params/fluid_params.h"

// The row of J_i^T along `f`: what a force f on the particle's place does to the body.
typedef struct {
  lanes of[6];
} Six;

static Six six_of(Lever r, float inverse_size, lanes fx, lanes fy, lanes fz) {
  const Six six = {{fx, fy, fz, inverse_size * (r.y * fz - r.z * fy),
                    inverse_size * (r.z * fx - r.x * fz), inverse_size * (r.x * fy - r.y * fx)}};
  return six;
}

// Adds weight q q^T to a lower triangle.
static void add_square(lanes* sum, const Six* q, lanes weight) {
  for (int r = 0; r < 6; ++r) {
    const lanes part = weight * q->of[r];
    for (int c = 0; c <= r; ++c) sum[SIX_AT(r, c)] += part * q->of[c];
  }
}

static void add_water(const Reach* r, Lever lever, float inverse_size, lanes pushing,
                      float rubbing, lanes* sum) {
  const lanes none = 0.0f, one = 1.0f;
  const Six along = six_of(lever, inverse_size, r->gx, r->gy, r->gz);
  const Six rub = six_of(lever, inverse_size, r->ax, r->ay, r->az);
  const Six x = six_of(lever, inverse_size, one, none, none);
  const Six y = six_of(lever, inverse_size, none, one, none);
  const Six z = six_of(lever, inverse_size, none, none, one);
  for (int k = 0; k < 6; ++k) sum[k] += pushing * along.of[k] - rubbing * rub.of[k];
  add_square(sum + 6, &along, r->yield);
  add_square(sum + 6, &x, r->rub);
  add_square(sum + 6, &y, r->rub);
  add_square(sum + 6, &z, r->rub);
}

// Pushes on each free body and the water's inertia, of one part of the water: one work-group for
// each body and part. `pushing`: of the pressure given, in it and in seconds; `rubbing`: of a_i,
// likewise.
kernel void weigh_water(constant FluidParams* p, float pushing, float rubbing,
                        constant FreeBody* frees, global const BodyStep* bodies, int first_body,
                        global const float* position, global const float* pressure,
                        global float* reach, global const int* reached, global float* parts) {
  local float of_team[SPLASH_PUSH_ENTRIES * TEAM];
  const int number = get_group_id(0), item = get_local_id(0), items = get_local_size(0);
  const int b = number / SPLASH_PUSH_PARTS, part = number % SPLASH_PUSH_PARTS;
  const int groups = group_count(p);
  const Share share = share_of(groups, part, SPLASH_PUSH_PARTS, 1, 1);
  const float inverse_size = 1.0f / frees[b].size;
  lanes sum[SPLASH_PUSH_ENTRIES];
  for (int e = 0; e < SPLASH_PUSH_ENTRIES; ++e) sum[e] = 0.0f;
  for (int group = share.first; group < share.last; group += share.step) {
    if (!reached[b * groups + group]) continue;
    const int i = group * LANES;
    const Reach r = load_reach(p, reach, b, i);
    const Lever lever = lever_of(p, position, bodies[first_body + frees[b].body], i);
    add_water(&r, lever, inverse_size, pushing * LOAD(pressure, i), rubbing, sum);
  }
  for (int e = 0; e < SPLASH_PUSH_ENTRIES; ++e) of_team[e * TEAM + item] = total(sum[e]);
  barrier(CLK_LOCAL_MEM_FENCE);
  for (int e = item; e < SPLASH_PUSH_ENTRIES; e += items) {
    float all = of_team[e * TEAM];
    for (int other = 1; other < items; ++other) all += of_team[e * TEAM + other];
    parts[number * SPLASH_PUSH_ENTRIES + e] = p->mass * all;
  }
}

static void add_tug(Tug tug, float size, float* sum) {
  vstore3(vload3(0, sum) + tug.push, 0, sum);
  vstore3(vload3(1, sum) + tug.turn / size, 1, sum);
  for (int r = 0; r < 3; ++r) {
    sum[6 + SIX_AT(r, r)] += tug.inertia;
    sum[6 + SIX_AT(r + 3, r + 3)] += tug.turn_inertia / (size * size);
  }
}

// One work-group for each free body. `falling`: of gravity [s], of the films' pushes
// (body_film.cl) where there are any, and of springs. `answer`: dV, dw. `felt`: what the
// water gave each body in this step so far, its momentum and angular momentum. `tugs`: what its
// spring gave it in this frame so far. `anchors`: of the free bodies in this step, from
// `first_anchor` on. The body's speeds in this step change at once.
kernel void answer_bodies(constant FluidParams* p, float falling, constant FreeBody* frees,
                          global BodyStep* bodies, int first_body, global const float* parts,
                          int films, global const float* film, global const Anchor* anchors,
                          int first_anchor, global float* answer, global float* felt,
                          global float* tugs) {
  local float of_team[SPLASH_PUSH_ENTRIES];
  const int item = get_group_id(0);
  for (int e = get_local_id(0); e < SPLASH_PUSH_ENTRIES; e += get_local_size(0)) {
    float all = 0.0f;
    for (int part = 0; part < SPLASH_PUSH_PARTS; ++part) {
      all += parts[(item * SPLASH_PUSH_PARTS + part) * SPLASH_PUSH_ENTRIES + e];
    }
    of_team[e] = all;
  }
  barrier(CLK_LOCAL_MEM_FENCE);
  if (get_local_id(0) > 0) return;
  const FreeBody f = frees[item];
  BodyStep b = bodies[first_body + f.body];
  float sum[SPLASH_PUSH_ENTRIES];
  for (int e = 0; e < SPLASH_PUSH_ENTRIES; ++e) sum[e] = of_team[e];
  float water[SPLASH_PUSH_ENTRIES];
  for (int e = 0; e < SPLASH_PUSH_ENTRIES; ++e) water[e] = sum[e];
  const float3 fall = falling * (float3)(p->gravity_x, p->gravity_y, p->gravity_z);
  sum[0] += f.mass * fall.x;
  sum[1] += f.mass * fall.y;
  sum[2] += f.mass * fall.z;
  for (int e = 0; films && e < 6; ++e) {
    const float press = falling * film[6 * item + e] / (e < 3 ? 1.0f : f.size);
    sum[e] += press;
    water[e] += press;
  }
  add_inertia(f, b, sum + 6);
  const bool tied = f.spring > 0.0f && falling > 0.0f;
  Tug tug = {(float3)(0.0f), (float3)(0.0f), 0.0f, 0.0f};
  if (tied) {
    tug = tug_of(f, b, anchors[first_anchor + item], falling);
    add_tug(tug, f.size, sum);
  }
  if (f.held) hold_six(f.held, sum, sum + 6);
  factor_six(sum + 6);
  solve_six(sum + 6, sum);
  const float3 dv = (float3)(sum[0], sum[1], sum[2]);
  const float3 dw = (float3)(sum[3], sum[4], sum[5]) / f.size;
  const float3 tugged = tug.push - tug.inertia * dv, twisted = tug.turn - tug.turn_inertia * dw;
  float3 pushed = f.mass * (dv - fall) - tugged, turned = inertia_times(f, b, dw) - twisted;
  if (f.held) {  // what holds it takes part, and is no water
    float felt_six[6];
    for (int r = 0; r < 6; ++r) felt_six[r] = water[r] - row_of_six(water + 6, r, sum);
    pushed = vload3(0, felt_six);
    turned = f.size * vload3(1, felt_six);
  }
  vstore3(dv, 2 * item, answer);
  vstore3(dw, 2 * item + 1, answer);
  vstore3(vload3(2 * item, felt) + pushed, 2 * item, felt);
  vstore3(vload3(2 * item + 1, felt) + turned, 2 * item + 1, felt);
  if (tied) sum_tug(first_body == 0, tugged, twisted, item, tugs);
  bodies[first_body + f.body] = faster_by(b, dv, dw);
}

// The water next to the bodies gets its part: one work-item for each group of particles. `velocity`
// changes by `factor` dv_i.
kernel void carry_water(constant FluidParams* p, int free_count, float factor,
                        constant FreeBody* frees, global const BodyStep* bodies, int first_body,
                        global const float* answer, global const float* position,
                        global float* reach, global const int* reached, global float* velocity) {
  const int groups = group_count(p);
  const int group = get_global_id(0);
  if (group >= groups) return;
  const int n = p->capacity, i = group * LANES;
  for (int b = 0; b < free_count; ++b) {
    if (!reached[b * groups + group]) continue;
    const Reach r = load_reach(p, reach, b, i);
    const Lever lever = lever_of(p, position, bodies[first_body + frees[b].body], i);
    const float3 dv = vload3(2 * b, answer), dw = vload3(2 * b + 1, answer);
    const lanes ux = dv.x + dw.y * lever.z - dw.z * lever.y;
    const lanes uy = dv.y + dw.z * lever.x - dw.x * lever.z;
    const lanes uz = dv.z + dw.x * lever.y - dw.y * lever.x;
    const lanes along = r.yield * (r.gx * ux + r.gy * uy + r.gz * uz);
    STORE(LOAD(velocity, i) + factor * (along * r.gx + r.rub * ux), velocity, i);
    STORE(LOAD(velocity + n, i) + factor * (along * r.gy + r.rub * uy), velocity + n, i);
    STORE(LOAD(velocity + 2 * n, i) + factor * (along * r.gz + r.rub * uz), velocity + 2 * n, i);
  }
}
