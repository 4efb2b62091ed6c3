// SPDX-License-Identifier: MIT
// Particles take from the grid what the step changed there, and move on:
//   v  = u + du                           u: velocity before, du: mean change of the faces around
//   x += dt (v - d) + dt^2 a              d: deviation, a: spacing
//   u' = v - (1 - exp(-rate dt)) (d - S d) + KICK dt a
// They are carried by what the grid sees of their motion, and lose of the rest what it sees least
// of: the second-order filter (1 - S)^2, which only takes energy and keeps momentum. Spacing is a
// displacement, of which little becomes speed.

#include "sim-server/fluid/boundary/keep_in_tank.h"
#include "sim-server/fluid/lanes/lanes.h"
#include "sim-server/fluid/params/fluid_params.h"
#include "sim-server/fluid/pressure/grid_projected/mac_cell.h"
#include "sim-server/fluid/pressure/grid_projected/mac_grid.h"

#define KICK 0.05f         // part of the spacing's push that stays as speed [1]
#define SEEN 1e-3f         // faces around a particle weigh this at least, or it falls freely [1]

// Mean change of the known faces around a particle along an axis; where there is none it falls.
static float change_along(constant MacGrid* g, const Placed* at, int axis,
                          global const float* change, global const int* flags, float falls) {
  const Around a = around(g, at, axis);
  const int cells = g->level[0].cells;
  float sum = 0.0f, weight = 0.0f;
  for (int k = 0; k < 8; ++k) {
    if ((flags[a.cell[k]] & MAC_FACE(axis)) == 0) continue;
    sum += a.weight[k] * change[axis * cells + a.cell[k]];
    weight += a.weight[k];
  }
  return weight > SEEN && at->on_grid ? sum / weight : falls;
}

// `filtered`: 1 - exp(-rate dt). `carried`: the velocity that took each particle where it is.
kernel void move_particles(constant FluidParams* p, constant MacGrid* g, float dt, float filtered,
                           float piston, float piston_speed, global const float* change,
                           global const int* flags, global const float* seen,
                           global const float* deviation, global float* acceleration,
                           global float* position, global float* velocity,
                           global float* carried) {
  const int n = p->capacity;
  const int first = get_global_id(0) * LANES;
  const int last = min(first + LANES, p->count);
  if (first >= last) return;
  float gains[3][LANES], rests[3][LANES];
  for (int lane = 0; lane < LANES; ++lane) {
    const int i = min(first + lane, last - 1);
    const float x = position[i], y = position[n + i], z = position[2 * n + i];
    const Placed at = place_on_grid(g, x, y, z);
    const float3 again = from_faces(g, &at, seen);
    const float part[3] = {again.x, again.y, again.z};
    const float falls[3] = {dt * (p->gravity_x - p->pull_x * (x - p->centre_x)),
                            dt * (p->gravity_y - p->pull_y * (y - p->centre_y)),
                            dt * (p->gravity_z - p->pull_z * (z - p->centre_z))};
    for (int axis = 0; axis < 3; ++axis) {
      gains[axis][lane] = change_along(g, &at, axis, change, flags, falls[axis]);
      rests[axis][lane] = at.on_grid ? deviation[axis * n + i] - part[axis] : 0.0f;
    }
  }
  lanes x[3], u[3], way[3], before[3];
  for (int axis = 0; axis < 3; ++axis) {
    const lanes a = LOAD(acceleration + axis * n, first);
    before[axis] = LOAD(velocity + axis * n, first);
    const lanes v = before[axis] + LOAD(gains[axis], 0);
    way[axis] = v - LOAD(deviation + axis * n, first) + dt * a;
    u[axis] = v - filtered * LOAD(rests[axis], 0) + KICK * dt * a;
  }
  const lanes slower =
      fmin(p->speed_limit * rsqrt(u[0] * u[0] + u[1] * u[1] + u[2] * u[2]), 1.0f);
  const lanes shorter =
      fmin(p->speed_limit * rsqrt(way[0] * way[0] + way[1] * way[1] + way[2] * way[2]), 1.0f);
  lanes from[3];
  for (int axis = 0; axis < 3; ++axis) {
    from[axis] = LOAD(position + axis * n, first);
    u[axis] *= slower;
    way[axis] *= shorter;
    x[axis] = from[axis] + dt * way[axis];
  }
  const lanes free[3] = {x[0], x[1], x[2]};
  keep_in_tank(p, piston, piston_speed, &x[0], &x[1], &x[2], &u[0], &u[1], &u[2]);
  for (int axis = 0; axis < 3; ++axis) {
    const lane_flags stopped = x[axis] != free[axis];
    STORE(select(way[axis], (x[axis] - from[axis]) / dt, stopped), carried + axis * n, first);
    STORE(x[axis], position + axis * n, first);
    STORE(u[axis], velocity + axis * n, first);
    STORE((u[axis] - before[axis]) / dt, acceleration + axis * n, first);
  }
}
