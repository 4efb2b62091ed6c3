// SPDX-License-Identifier: MIT
// Free bodies before a solve: they fall as if there were no water, and what holds on to them is
// found (coupling.h).
// What stopped a body in the last step, a floor or another body, is taken to stop it again, as far
// as that only carries it: else water would flow around a body that falls, and lies. The solve
// done, it is taken back, and contacts (free_bodies/body_move.cl) find what is true.

#include "sim-server/fluid/boundary/bodies.h"
#include "sim-server/fluid/boundary/outline.h"
#include "sim-server/fluid/params/fluid_params.h"
#include "sim-server/fluid/pressure/grid_projected/coupling.h"
#include "sim-server/fluid/pressure/grid_projected/mac_cell.h"
#include "sim-server/fluid/pressure/grid_projected/mac_grid.h"
#include "sim-server/fluid/pressure/grid_projected/room.h"

// No longer than `most`.
static float3 shortened(float3 a, float most) {
  const float long2 = dot(a, a);
  return long2 > most * most ? most * rsqrt(long2) * a : a;
}

// One work-item for each free body. `kept`: SPLASH_KEPT_FLOATS of each, zeros at first.
kernel void let_fall(constant FluidParams* p, float dt, int free_count, constant FreeBody* frees,
                     global BodyStep* bodies, int first_body, global float* kept) {
  const int k = get_global_id(0);
  if (k >= free_count) return;
  const FreeBody f = frees[k];
  global float* own = kept + k * SPLASH_KEPT_FLOATS;
  BodyStep b = bodies[first_body + f.body];
  float3 fall = dt * (float3)(p->gravity_x, p->gravity_y, p->gravity_z);
  if (f.held) fall *= free_ways(f);
  float3 held = (float3)(0.0f), turned = (float3)(0.0f);
  if (own[KEPT_ANY] > 0.0f) {
    const float most = length(fall);
    held = shortened((float3)(b.vx - own[0], b.vy - own[1], b.vz - own[2]), most);
    turned = shortened((float3)(b.wx - own[3], b.wy - own[4], b.wz - own[5]), most / f.size);
  }
  b.vx += fall.x + held.x;
  b.vy += fall.y + held.y;
  b.vz += fall.z + held.z;
  b.wx += turned.x;
  b.wy += turned.y;
  b.wz += turned.z;
  vstore3(held, 0, own + KEPT_HELD);
  vstore3(turned, 0, own + KEPT_TURNED);
  bodies[first_body + f.body] = b;
}

// K of each cell that is a free body's, by the body's lever.
kernel void grip_water(constant MacGrid* g, int free_count, constant FreeBody* frees,
                       constant BodyShape* shapes, global const BodyStep* bodies, int first_body,
                       global const float* gap, global const int* owner, global const float* wet,
                       global const float* air, global float* grip) {
  const int4 at = cell_of(g, get_global_id(0));
  const MacLevel l = g->level[0];
  if (at.w == 0 || at.x == l.nx || at.y == l.ny || at.z == l.nz) return;
  const int c = number_of(l, at);
  for (int k = 0; k < free_count; ++k) {
    const FreeBody f = frees[k];
    if (owner[c] != f.body) continue;
    const BodyStep b = bodies[first_body + f.body];
    float3 push = (float3)(0.0f), turn = (float3)(0.0f);
    const int step[3] = {1, l.row, l.layer};
    const float inverse[3] = {g->ix, g->iy, g->iz};
    const bool pushes = (HAS_POCKETS ? fmax(wet[c], air[c]) : wet[c]) > 0.0f;
    for (int axis = 0; axis < 3 && pushes; ++axis) {
      const int face = axis * l.cells + c;
      const float3 e = (float3)(axis == 0, axis == 1, axis == 2);
      const float3 arm = face_middle(g, at, axis) - (float3)(b.px, b.py, b.pz);
      const float3 next = arm + e * (float3)(g->hx, g->hy, g->hz);
      const float low = inverse[axis] * gap[face], high = inverse[axis] * gap[face + step[axis]];
      push += (high - low) * e;
      turn += (high * cross(next, e) - low * cross(arm, e)) / f.size;
    }
    turn = moment_of_pressures(shapes[f.body], b, turn);
    grip[c] = push.x;
    grip[l.cells + c] = push.y;
    grip[2 * l.cells + c] = push.z;
    grip[3 * l.cells + c] = turn.x;
    grip[4 * l.cells + c] = turn.y;
    grip[5 * l.cells + c] = turn.z;
  }
}

// The solve done: what the pressures `found` give each body, which is `felt`, too. One work-group.
kernel void push_bodies(constant FluidParams* p, constant MacGrid* g, int free_count,
                        constant FreeBody* frees, global BodyStep* bodies, int first_body,
                        global const int* owner, global const float* grip,
                        global const float* found, global const float* entrained,
                        global float* kept, global float* felt) {
  local float parts[JUDGES];
  const float heavy = p->rest_density * g->hx * g->hy * g->hz;
  const Coupling all = {free_count, frees, bodies + first_body, owner, grip, heavy, entrained};
  for (int k = 0; k < free_count; ++k) {
    float push[6], answer[6];
    find_push(g, &all, k, found, parts, push);
    if (FIRST_ITEM > 0) continue;
    answer_push(&all, k, push, answer);
    const FreeBody f = frees[k];
    BodyStep b = bodies[first_body + f.body];
    const float3 dv = -(float3)(answer[0], answer[1], answer[2]);
    const float3 dw = -(float3)(answer[3], answer[4], answer[5]) / f.size;
    global float* own = kept + k * SPLASH_KEPT_FLOATS;
    b = faster_by(b, dv, dw);
    float given[6];
    give_entrained(f, b, entrained + k * SPLASH_ENTRAINED_FLOATS, given);
    for (int e = 0; e < 6; ++e) given[e] -= heavy * push[e];
    const float3 force = vload3(0, given), torque = f.size * vload3(1, given);
    vstore3(vload3(2 * k, felt) + force, 2 * k, felt);
    vstore3(vload3(2 * k + 1, felt) + torque, 2 * k + 1, felt);
    const float3 v = (float3)(b.vx, b.vy, b.vz) - vload3(0, own + KEPT_HELD);
    const float3 w = (float3)(b.wx, b.wy, b.wz) - vload3(0, own + KEPT_TURNED);
    set_speeds(v, w, &b);
    bodies[first_body + f.body] = b;
    vstore3(v, 0, own + KEPT_SPEED);
    vstore3(w, 0, own + KEPT_SPIN);
    own[KEPT_ANY] = 1.0f;
  }
}
