// SPDX-License-Identifier: MIT
// Particles take from the grid what the step changed there, and move on:
//   v  = u + du          u: velocity before, du: mean change of the faces around, sharpened
//   x += dt (w + c) + dt^2 a   w: the grid's velocity half a step ahead, sharpened; c: what keeps
//                              the cells' volumes (crowding.cl); a: spacing
//   u' = v - (1 - exp(-rate dt)) (d - S d) + kick dt a              d: deviation
// They are carried by what the grid sees of their motion, v - d, as it is where that takes them in
// half a step (midpoint rule): a step along where they are would press strained water together by
// dt^2 tr(grad w grad w) / 2. They lose of the rest what the grid sees least of: the second-order
// filter (1 - S)^2, which only takes energy and keeps momentum. Spacing is a displacement, of which
// little becomes speed, and c one of which nothing does.

#include "sim-server/fluid/boundary/keep_out.h"
#include "sim-server/fluid/boundary/walls.h"
#include "sim-server/fluid/lanes/lanes.h"
#include "sim-server/fluid/params/fluid_params.h"
#include "sim-server/fluid/pressure/grid_projected/mac_cell.h"
#include "sim-server/fluid/pressure/grid_projected/mac_grid.h"

#define ALL_KNOWN 0.999f  // weight of the faces around that are known, if none is missing [1]

// What the grid does not see of the particles' velocities: d = v - S v, with S from the particles
// to the faces and back, which is symmetric and has eigenvalues from 0 to 1. What is above the grid
// deviates by nothing.
kernel void find_deviation(constant FluidParams* p, constant MacGrid* g,
                           global const float* position, global const float* velocity,
                           global const float* mean, global float* deviation) {
  const int n = p->capacity;
  const int i = get_global_id(0) * LANES;
  if (i >= p->count) return;
  const Placed at =
      place_on_grid(g, LOAD(position, i), LOAD(position + n, i), LOAD(position + 2 * n, i));
  const lanes none = 0.0f;
  for (int axis = 0; axis < 3; ++axis) {
    const lanes unseen = LOAD(velocity + axis * n, i) - sum_of_faces(g, &at, axis, mean, 0).whole;
    STORE(select(none, unseen, at.on_grid), deviation + axis * n, i);
  }
}

// What velocities are multiplied by to stay below the limit; 1 where they are none.
static lanes slowed(constant FluidParams* p, const lanes v[3]) {
  const lanes size = inverse_root(v[0] * v[0] + v[1] * v[1] + v[2] * v[2]);
  return fmin(p->speed_limit * size, (lanes)(1.0f));
}

// What falls, along the axes for which the grid knows no face around it, goes on until it touches a
// wall, half a spacing off, as its lattice begins: of what would come nearer, the motion towards
// the wall ends. `loose`: 1 where it falls along an axis, or 0. `from`: where the step begins,
// `way`: the velocity of its motion.
static void touch_walls(constant FluidParams* p, float dt, float piston, float piston_speed,
                        const lanes loose[3], const lanes from[3], lanes way[3], lanes u[3]) {
  const lanes none = 0.0f;
  for (int k = 0; k < p->wall_count; ++k) {
    const float n[3] = {p->walls[k].nx, p->walls[k].ny, p->walls[k].nz};
    const lanes part = n[0] * n[0] * loose[0] + n[1] * n[1] * loose[1] + n[2] * n[2] * loose[2];
    const lane_flags falls = part > (lanes)(0.5f);
    if (!any_lane(falls)) continue;
    const float speed = k == p->piston ? piston_speed : 0.0f;
    const lanes gap = wall_distance(p, k, from[0], from[1], from[2], piston) - 0.5f * p->spacing;
    const lanes allowed = speed - fmax(gap, none) / dt;
    const lanes excess = allowed - (n[0] * way[0] + n[1] * way[1] + n[2] * way[2]);
    const lane_flags touches = falls & (excess > none);
    const lanes stopped = fmax(speed - (n[0] * u[0] + n[1] * u[1] + n[2] * u[2]), none);
    for (int axis = 0; axis < 3; ++axis) {
      way[axis] += select(none, n[axis] * excess, touches);
      u[axis] += select(none, n[axis] * stopped, touches);
    }
  }
}

// Turns velocities `way` into the grid's half a step ahead along them, where all faces around are
// known, there and where the particles are (`whole`).
static void look_ahead(constant MacGrid* g, float dt, global const float* carries,
                       global const float* change, const lane_flags whole[3], const lanes from[3],
                       lanes way[3]) {
  const lanes half_step = 0.5f * dt;
  const Placed at = place_on_grid(g, from[0] + half_step * way[0], from[1] + half_step * way[1],
                                  from[2] + half_step * way[2]);
  for (int axis = 0; axis < 3; ++axis) {
    const FaceSums there = sum_of_faces(g, &at, axis, carries, change);
    const lane_flags inner = whole[axis] & at.on_grid & (there.weight > (lanes)(ALL_KNOWN));
    way[axis] = select(way[axis], there.whole + there.known, inner);
  }
}

// `filtered`: 1 - exp(-rate dt). `kick`: part of the spacing's push that stays as speed. `carried`:
// the velocity that took each particle where it is. `moving`: all of them do. `jolt`: acceleration
// by the spacing to bodies [m/s2]; if any body is felt (`feels` is not 0), it is replaced by the
// change of velocity that this and moving particles back out of bodies caused [m/s].
kernel void move_particles(constant FluidParams* p, constant MacGrid* g, float dt, float filtered,
                           float kick, float piston, float piston_speed, constant BodyShape* shapes,
                           global const float* meshes, global const BodyStep* bodies,
                           int first_body, int body_count, global const float* carries,
                           global const float* change, global const float* gain,
                           global const float* seen, global const float* shift,
                           global const float* deviation, global float* acceleration,
                           global float* position, global float* velocity, global float* carried,
                           global int* moving, int feels, global float* jolt) {
  const int n = p->capacity;
  const int first = get_global_id(0) * LANES;
  if (first >= p->count) return;
  lanes from[3], x[3], u[3], way[3], before[3];
  for (int axis = 0; axis < 3; ++axis) from[axis] = LOAD(position + axis * n, first);
  const Placed at = place_on_grid(g, from[0], from[1], from[2]);
  const lanes falls[3] = {dt * (p->gravity_x - p->pull_x * (from[0] - p->centre_x)),
                          dt * (p->gravity_y - p->pull_y * (from[1] - p->centre_y)),
                          dt * (p->gravity_z - p->pull_z * (from[2] - p->centre_z))};
  const lanes none = 0.0f;
  lanes loose[3], spaced[3];
  lane_flags inner[3];
  for (int axis = 0; axis < 3; ++axis) {
    const lanes a = LOAD(acceleration + axis * n, first);
    const lanes d = LOAD(deviation + axis * n, first);
    const FaceSums here = sum_of_faces(g, &at, axis, seen, gain);
    const lanes twice = select(none, d - here.whole, at.on_grid);
    // Where no face is known particles fall.
    const lane_flags known = at.on_grid & (here.weight > (lanes)(MAC_SEEN));
    loose[axis] = select((lanes)(1.0f), none, known);
    before[axis] = LOAD(velocity + axis * n, first);
    const lanes v = before[axis] + select(falls[axis], here.known / here.weight, known);
    inner[axis] = at.on_grid & (here.weight > (lanes)(ALL_KNOWN));
    spaced[axis] = dt * a;
    way[axis] = v - d;
    u[axis] = v - filtered * twice + kick * spaced[axis];
  }
  look_ahead(g, dt, carries, change, inner, from, way);
  for (int axis = 0; axis < 3; ++axis) {
    const lanes shifted = sum_of_faces(g, &at, axis, shift, 0).whole;
    way[axis] += spaced[axis] + select(none, shifted, at.on_grid);
  }
  touch_walls(p, dt, piston, piston_speed, loose, from, way, u);
  const lanes slower = slowed(p, u), shorter = slowed(p, way);
  for (int axis = 0; axis < 3; ++axis) {
    u[axis] *= slower;
    way[axis] *= shorter;
    x[axis] = from[axis] + dt * way[axis];
  }
  const lanes free[3] = {x[0], x[1], x[2]};
  const Bodies near = {shapes, meshes, bodies, first_body, body_count};
  const lanes unstopped[3] = {u[0], u[1], u[2]};
  keep_lanes_out(p, &near, from, x, u);
  for (int axis = 0; axis < 3 && feels; ++axis) {
    const lanes push = kick * dt * LOAD(jolt + axis * n, first);
    STORE(push + u[axis] - unstopped[axis], jolt + axis * n, first);
  }
  keep_in_tank(p, piston, piston_speed, &x[0], &x[1], &x[2], &u[0], &u[1], &u[2]);
  const float per_step = 1.0f / dt;
  const lane_flags here = LANE_NUMBERS < (lane_flags)(p->count - first);
  STORE(here, moving, first);
  for (int axis = 0; axis < 3; ++axis) {
    const lane_flags stopped = x[axis] != free[axis];
    STORE(select(way[axis], (x[axis] - from[axis]) * per_step, stopped), carried + axis * n, first);
    STORE(select(from[axis], x[axis], here), position + axis * n, first);
    STORE(select(before[axis], u[axis], here), velocity + axis * n, first);
    STORE((u[axis] - before[axis]) * per_step, acceleration + axis * n, first);
  }
}
