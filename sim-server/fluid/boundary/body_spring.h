// SPDX-License-Identifier: MIT
// A spring and a damper between a device and the body that hangs on it, alike in all directions:
//   F = k (x_d - x) + b (v_d - V),   T = k_r theta + b_r (w_d - w)
// theta the turn from the body to the device. They are taken at the step's end (implicit Euler),
//   x = x_0 + dt (V_0 + dV),   x_d = x_d0 + dt v_d,   V = V_0 + dV,
// so that they give the body no energy, however long the step and however light the body: an
// inertia of dt (b + dt k) is added to its own.

#include "sim-server/fluid/boundary/bodies.h"
#include "sim-server/fluid/params/fluid_params.h"

typedef struct {
  float3 push, turn;            // of a body whose speeds do not change [N s], [N m s]
  float inertia, turn_inertia;  // less this by each change of speed [kg], [kg m2]
} Tug;

// The turn that takes the body to the device, shorter way round [rad].
static float3 turn_to(Anchor a, BodyStep b) {
  const float3 u = (float3)(a.qx, a.qy, a.qz), v = (float3)(b.qx, b.qy, b.qz);
  const float real = a.qw * b.qw + dot(u, v);
  const float3 axis = b.qw * u - a.qw * v - cross(u, v);
  const float3 shorter = real < 0.0f ? -axis : axis;
  const float half_sine = length(shorter);
  if (half_sine < 1.0e-6f) return 2.0f * shorter;
  return 2.0f * atan2(half_sine, fabs(real)) / half_sine * shorter;
}

// What the spring does in a step of `dt`.
static Tug tug_of(FreeBody f, BodyStep b, Anchor a, float dt) {
  const float3 v = (float3)(b.vx, b.vy, b.vz), w = (float3)(b.wx, b.wy, b.wz);
  const float3 slower = (float3)(a.vx, a.vy, a.vz) - v,
               turns_slower = (float3)(a.wx, a.wy, a.wz) - w;
  const float3 way = (float3)(a.px - b.px, a.py - b.py, a.pz - b.pz);
  Tug tug;
  tug.inertia = dt * (f.damper + dt * f.spring);
  tug.turn_inertia = dt * (f.turning_damper + dt * f.turning_spring);
  tug.push = dt * f.spring * way + tug.inertia * slower;
  tug.turn = dt * f.turning_spring * turn_to(a, b) + tug.turn_inertia * turns_slower;
  return tug;
}

// Adds what the spring of free body `k` gave it [N s], [N m s] to the frame's sum, which its first
// step begins.
static void sum_tug(bool begins, float3 push, float3 turn, int k, global float* tugs) {
  const float3 none = (float3)(0.0f);
  vstore3((begins ? none : vload3(2 * k, tugs)) + push, 2 * k, tugs);
  vstore3((begins ? none : vload3(2 * k + 1, tugs)) + turn, 2 * k + 1, tugs);
}
