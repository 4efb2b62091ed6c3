// SPDX-License-Identifier: MIT
// Free bodies that hang on devices by springs (boundary/body_spring.h), in the pressures' system
// (coupling.h). A spring that is taken at the step's end gives less by I for each change of speed,
// so its body is heavier by that, and falls along
//   (M + I) dq = M g dt + tug

#include "sim-server/fluid/boundary/bodies.h"
#include "sim-server/fluid/boundary/body_inertia.h"
#include "sim-server/fluid/boundary/body_spring.h"
#include "sim-server/fluid/params/fluid_params.h"
#include "sim-server/fluid/pressure/grid_projected/coupling.h"
#include "sim-server/fluid/pressure/grid_projected/mac_grid.h"

// The body's speeds as the step began, for what let_fall has made of them.
static BodyStep before_falling(BodyStep b, float3 fall, global const float* own) {
  const float3 v = (float3)(b.vx, b.vy, b.vz) - fall - vload3(0, own + KEPT_HELD);
  const float3 w = (float3)(b.wx, b.wy, b.wz) - vload3(0, own + KEPT_TURNED);
  set_speeds(v, w, &b);
  return b;
}

// After let_fall: one work-item for each free body. `tied`: the bodies as heavy as their springs
// make them; `tuggings`: SPLASH_TUG_FLOATS of each, for tell_tugs.
kernel void tie_bodies(constant FluidParams* p, float dt, int free_count, constant FreeBody* frees,
                       global BodyStep* bodies, int first_body, global const float* kept,
                       global const Anchor* anchors, int first_anchor, global FreeBody* tied,
                       global float* tuggings) {
  const int k = get_global_id(0);
  if (k >= free_count) return;
  FreeBody f = frees[k];
  global float* own = tuggings + k * SPLASH_TUG_FLOATS;
  BodyStep b = bodies[first_body + f.body];
  const float3 fall = dt * (float3)(p->gravity_x, p->gravity_y, p->gravity_z);
  const BodyStep before = before_falling(b, fall, kept + k * SPLASH_KEPT_FLOATS);
  Tug tug = {(float3)(0.0f), (float3)(0.0f), 0.0f, 0.0f};
  if (f.spring > 0.0f) tug = tug_of(f, before, anchors[first_anchor + k], dt);
  f.mass += tug.inertia;
  f.ix += tug.turn_inertia;
  f.iy += tug.turn_inertia;
  f.iz += tug.turn_inertia;
  const float3 dv = (tug.push - tug.inertia * fall) / f.mass;
  const float3 dw = inertia_solve(f, b, tug.turn);
  bodies[first_body + f.body] = faster_by(b, dv, dw);
  tied[k] = f;
  vstore3((float3)(before.vx, before.vy, before.vz), 0, own);
  vstore3((float3)(before.wx, before.wy, before.wz), 1, own);
  vstore3(tug.push, 2, own);
  vstore3(tug.turn, 3, own);
  own[12] = tug.inertia;
  own[13] = tug.turn_inertia;
}

// The solve done: what each spring gave its body, added to `tugs` of the frame's steps before.
kernel void tell_tugs(int free_count, constant FreeBody* frees, global const BodyStep* bodies,
                      int first_body, global const float* tuggings, global float* tugs) {
  const int k = get_global_id(0);
  if (k >= free_count) return;
  global const float* own = tuggings + k * SPLASH_TUG_FLOATS;
  const BodyStep b = bodies[first_body + frees[k].body];
  const float3 dv = (float3)(b.vx, b.vy, b.vz) - vload3(0, own);
  const float3 dw = (float3)(b.wx, b.wy, b.wz) - vload3(1, own);
  sum_tug(first_body == 0, vload3(2, own) - own[12] * dv, vload3(3, own) - own[13] * dw, k, tugs);
}
