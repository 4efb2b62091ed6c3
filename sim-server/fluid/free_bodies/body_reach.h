// SPDX-License-Identifier: MIT
// What a free body and a particle in its reach do to each other in a step.
//   the particle is pushed by           - P_i g_i + a_i,  and the body by the opposite
//   and yields to the body's motion by    b_i g_i (g_i . u) + c_i u
// with g_i the gradient of its density by the body's points, a_i what rubs, and u how much the
// body's speed, where the particle is, changes in the step. All forces of a pair of points lie on
// the line between them, so that they act on the body with the particle's own lever, x_i - c.
//
// Why water yields: forces are found for a body that moves on as it did. A body lighter than the
// water that it drives, its added mass, then overshoots, and each step's overshoot is the next
// one's push: that explodes, whatever the step (Foerster, Wall & Ramm 2007). So each push answers
// within the step to how the body's speed changes: the pressure by what the state equation makes of
// the way in a step, b_i = (c0 dt / rho_i)^2; what rubs by its own coefficient. For the body this
// is an inertia,
//   M + sum_i m J_i^T (b_i g_i g_i^T + c_i 1) J_i,   u = J_i (V, w),
// that of the water next to it; what it carries of the body's momentum the particles get. So
// nothing is lost, a heavy body feels none of it, and all of it vanishes with the step.

#include "sim-server/fluid/lanes/lanes.h"
#include "sim-server/fluid/params/fluid_params.h"

typedef struct {
  lanes gx, gy, gz;  // g_i [kg/m4]
  lanes ax, ay, az;  // a_i [m/s2]
  lanes rub;         // c_i [1]
  lanes yield;       // b_i [m8/kg2]
} Reach;

static global float* reach_part(constant FluidParams* p, global float* reach, int k, int field) {
  return reach + ((size_t)k * SPLASH_REACH_FIELDS + field) * p->capacity;
}

static void store_reach(constant FluidParams* p, global float* reach, int k, int i,
                        const Reach* r) {
  STORE(r->gx, reach_part(p, reach, k, 0), i);
  STORE(r->gy, reach_part(p, reach, k, 1), i);
  STORE(r->gz, reach_part(p, reach, k, 2), i);
  STORE(r->ax, reach_part(p, reach, k, 3), i);
  STORE(r->ay, reach_part(p, reach, k, 4), i);
  STORE(r->az, reach_part(p, reach, k, 5), i);
  STORE(r->rub, reach_part(p, reach, k, 6), i);
  STORE(r->yield, reach_part(p, reach, k, 7), i);
}

static Reach load_reach(constant FluidParams* p, global float* reach, int k, int i) {
  Reach r;
  r.gx = LOAD(reach_part(p, reach, k, 0), i);
  r.gy = LOAD(reach_part(p, reach, k, 1), i);
  r.gz = LOAD(reach_part(p, reach, k, 2), i);
  r.ax = LOAD(reach_part(p, reach, k, 3), i);
  r.ay = LOAD(reach_part(p, reach, k, 4), i);
  r.az = LOAD(reach_part(p, reach, k, 5), i);
  r.rub = LOAD(reach_part(p, reach, k, 6), i);
  r.yield = LOAD(reach_part(p, reach, k, 7), i);
  return r;
}

static int group_count(constant FluidParams* p) { return (p->count + LANES - 1) / LANES; }

typedef struct {
  lanes x, y, z;
} Lever;

// From the body's centre to the particles.
static Lever lever_of(constant FluidParams* p, global const float* position, BodyStep b, int i) {
  const int n = p->capacity;
  const Lever lever = {LOAD(position, i) - b.px, LOAD(position + n, i) - b.py,
                       LOAD(position + 2 * n, i) - b.pz};
  return lever;
}
