// SPDX-License-Identifier: MIT
// A free body's inertia in the world: R diag(ix, iy, iz) R^T.

// Angular momentum of a spin.
static float3 inertia_times(FreeBody f, BodyStep b, float3 spin) {
  return out_of_body(b, (float3)(f.ix, f.iy, f.iz) * into_body(b, spin));
}

// Spin of an angular momentum.
static float3 inertia_solve(FreeBody f, BodyStep b, float3 momentum) {
  return out_of_body(b, into_body(b, momentum) / (float3)(f.ix, f.iy, f.iz));
}
