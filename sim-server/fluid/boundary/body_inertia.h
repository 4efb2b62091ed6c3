// SPDX-License-Identifier: MIT
// A free body's inertia in the world: R diag(ix, iy, iz) R^T, R from its principal axes, which are
// its own but for a mesh's. Along, or about, axes of the world by which it is held it does not
// move, whatever pushes: what holds it pushes back.

#include "sim-server/fluid/boundary/bodies.h"
#include "sim-server/fluid/boundary/six.h"
#include "sim-server/fluid/params/fluid_params.h"
#include "sim-server/fluid/params/parts.h"

static float3 into_principal(FreeBody f, BodyStep b, float3 v) {
  const float3 own = into_body(b, v);
  return HAS_MESH ? rotate_by(own, -f.ax, -f.ay, -f.az, f.aw) : own;
}

static float3 out_of_principal(FreeBody f, BodyStep b, float3 v) {
  return out_of_body(b, HAS_MESH ? rotate_by(v, f.ax, f.ay, f.az, f.aw) : v);
}

// Angular momentum of a spin.
static float3 inertia_times(FreeBody f, BodyStep b, float3 spin) {
  return out_of_principal(f, b, (float3)(f.ix, f.iy, f.iz) * into_principal(f, b, spin));
}

// 1 along what a body is free to move along, or to turn about; 0 where it is held.
static float3 free_ways(FreeBody f) {
  return (float3)(f.held & 1 ? 0.0f : 1.0f, f.held & 2 ? 0.0f : 1.0f, f.held & 4 ? 0.0f : 1.0f);
}

static float3 free_turns(FreeBody f) {
  return (float3)(f.held & 8 ? 0.0f : 1.0f, f.held & 16 ? 0.0f : 1.0f, f.held & 32 ? 0.0f : 1.0f);
}

// Speed that an impulse gives.
static float3 mass_solve(FreeBody f, float3 impulse) {
  const float3 speed = impulse / f.mass;
  return f.held ? free_ways(f) * speed : speed;
}

// Spin of the angular momentum of a body that is held about some axes: I w = L but for these.
static float3 held_solve(FreeBody f, BodyStep b, float3 momentum) {
  const float3 turns = free_turns(f);
  const float scale = f.ix + f.iy + f.iz;
  const float3 x = (float3)(1.0f, 0.0f, 0.0f), y = (float3)(0.0f, 1.0f, 0.0f);
  const float3 z = (float3)(0.0f, 0.0f, 1.0f);
  const float3 a = turns.x * turns * inertia_times(f, b, x) / scale + (1.0f - turns.x) * x;
  const float3 c = turns.y * turns * inertia_times(f, b, y) / scale + (1.0f - turns.y) * y;
  const float3 e = turns.z * turns * inertia_times(f, b, z) / scale + (1.0f - turns.z) * z;
  const float3 right = turns * momentum / scale;
  const float3 first = cross(c, e);
  return (float3)(dot(right, first), dot(right, cross(e, a)), dot(right, cross(a, c))) /
         dot(a, first);
}

// Spin of an angular momentum.
static float3 inertia_solve(FreeBody f, BodyStep b, float3 momentum) {
  if (f.held >> 3) return held_solve(f, b, momentum);
  return out_of_principal(f, b, into_principal(f, b, momentum) / (float3)(f.ix, f.iy, f.iz));
}

// Adds M to a lower triangle, with spins as speeds at the body's lever.
static void add_inertia(FreeBody f, BodyStep b, float* a) {
  const float3 axes[3] = {(float3)(1.0f, 0.0f, 0.0f), (float3)(0.0f, 1.0f, 0.0f),
                          (float3)(0.0f, 0.0f, 1.0f)};
  for (int r = 0; r < 3; ++r) {
    a[SIX_AT(r, r)] += f.mass;
    const float3 column = inertia_times(f, b, axes[r]) / (f.size * f.size);
    for (int c = 0; c <= r; ++c) a[SIX_AT(r + 3, c + 3)] += dot(column, axes[c]);
  }
}
