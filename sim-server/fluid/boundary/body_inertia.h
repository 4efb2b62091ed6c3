// SPDX-License-Identifier: MIT
// A free body's inertia in the world: R diag(ix, iy, iz) R^T, R from its principal axes, which are
// its own but for a mesh's.

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

// Spin of an angular momentum.
static float3 inertia_solve(FreeBody f, BodyStep b, float3 momentum) {
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
