// SPDX-License-Identifier: MIT
// What a step's pressures do to bodies that go their own way, and how that would change if these
// were faster from the step's beginning on. With coupling.h's K, and A of the pressures' system,
//   dt F = - rho0 V K^T f,      d(dt F)/dq = - rho0 V K^T A^-1 K
// of which the diagonal is kept: the mass of the water that goes with the body. A^-1 K is found as
// f is, one part of q at a time; K^T A^-1 K is the energy that conjugate gradients come nearer to
// from below, by the square of their error. What the water near the body goes relative to it at the
// step's beginning has an answer as well, of which given.cl needs what it does far from the body.

#include "sim-server/fluid/params/fluid_params.h"
#include "sim-server/fluid/pressure/grid_projected/coupling.h"
#include "sim-server/fluid/pressure/grid_projected/mac_cell.h"
#include "sim-server/fluid/pressure/grid_projected/mac_grid.h"
#include "sim-server/fluid/pressure/grid_projected/room.h"

// With `only` < 0: adds dt F of each body to the first half of its twelve `sums`, its torque about
// the body's centre with it [N s], [N m s]. Otherwise: adds rho0 V K^T A^-1 K of `part` of the
// speeds of body `only` to the second half of its sums [kg], [kg m2]. One work-group.
kernel void weigh_pressure(constant FluidParams* p, constant MacGrid* g, int only, int part,
                           int body_count, constant FreeBody* felt, global BodyStep* bodies,
                           int first_body, global const int* owner, global const float* grip,
                           global const float* found, global float* sums) {
  local float parts[JUDGES];
  const float heavy = p->rest_density * g->hx * g->hy * g->hz;
  const Coupling all = {body_count, felt, bodies + first_body, owner, grip, heavy, 0};
  const int last = only < 0 ? body_count : only + 1;
  for (int k = max(only, 0); k < last; ++k) {
    float push[6];
    find_push(g, &all, k, found, parts, push);
    if (FIRST_ITEM > 0) continue;
    if (only < 0) {
      for (int e = 0; e < 6; ++e) {
        sums[12 * k + e] -= (e < 3 ? 1.0f : felt[k].size) * heavy * push[e];
      }
    } else {
      const float lever = part < 3 ? 1.0f : felt[k].size;
      sums[12 * k + 6 + part] += lever * lever * heavy * push[part];
    }
  }
}

// Water that flows through the lower face of a cell along an axis relative to a body that cuts the
// cell beside it, over the face's area [m/s].
static float flow_through(constant MacGrid* g, global const BodyStep* bodies, int body, float dt,
                          global const float* gap, global const float* mean, int4 at, int axis) {
  const MacLevel l = g->level[0];
  const int face = axis * l.cells + number_of(l, at);
  const int where = axis == 0 ? at.x : axis == 1 ? at.y : at.z;
  const bool wall = where == 0 || (axis < 2 && where == (axis == 0 ? l.nx : l.ny));
  const float solid = solid_at_face(g, bodies, body, dt, 0.0f, at, axis);
  return gap[face] * ((wall ? 0.0f : mean[face]) - solid);
}

// The system's right side becomes K of one `part` of the speeds of felt body `k`, or, if that is
// SPLASH_BY_FLOW, what of -div u the cells have that it cuts, relative to it and without gravity.
// The solution begins at zero.
kernel void ask_for_answer(constant MacGrid* g, int k, int part, float dt, constant FreeBody* felt,
                           global const BodyStep* bodies, int first_body, global const int* owner,
                           global const float* gap, global const float* mean,
                           global const float* grip, global const float* open, global float* x,
                           global float* right, global float* rest, global float* start,
                           global float* way) {
  const int4 at = cell_of(g, get_global_id(0));
  if (at.w == 0) return;
  const MacLevel l = g->level[0];
  const int c = number_of(l, at);
  const bool beside = owner[c] == felt[k].body && open[c] > 0.0f;  // it has an equation
  float b = beside && part != SPLASH_BY_FLOW ? grip[part * l.cells + c] : 0.0f;
  for (int axis = 0; axis < 3 && beside && part == SPLASH_BY_FLOW; ++axis) {
    const int4 next = at + (int4)(axis == 0, axis == 1, axis == 2, 0);
    const float inverse = axis == 0 ? g->ix : axis == 1 ? g->iy : g->iz;
    b += inverse * (flow_through(g, bodies + first_body, owner[c], dt, gap, mean, at, axis) -
                    flow_through(g, bodies + first_body, owner[c], dt, gap, mean, next, axis));
  }
  right[c] = b;
  x[c] = rest[c] = start[c] = way[c] = 0.0f;
}
