// SPDX-License-Identifier: MIT
// What the water that a body entrains (entrained.cl) gives it.

#include "sim-server/fluid/boundary/bodies.h"
#include "sim-server/fluid/boundary/six.h"
#include "sim-server/fluid/params/fluid_params.h"

static BodyStep faster_by(BodyStep b, float3 dv, float3 dw) {
  set_speeds((float3)(b.vx, b.vy, b.vz) + dv, (float3)(b.wx, b.wy, b.wz) + dw, &b);
  return b;
}

// What that water loses when it goes as the body does, R - E q.
static void give_entrained(FreeBody f, BodyStep b, global const float* water, float* given) {
  const float q[6] = {b.vx, b.vy, b.vz, f.size * b.wx, f.size * b.wy, f.size * b.wz};
  float inertia[SIX_ENTRIES];
  for (int e = 0; e < SIX_ENTRIES; ++e) inertia[e] = water[e];
  for (int e = 0; e < 6; ++e) given[e] = water[SIX_ENTRIES + e] - row_of_six(inertia, e, q);
}
