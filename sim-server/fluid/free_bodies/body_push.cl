// SPDX-License-Identifier: MIT
// What the water gives bodies that go their own way, over the steps of a frame (body_reach.h):
//   sum dt F = sum_k sum_i m J_i^T (dt P_i g_i - dt a_i)
// and how that would change if the bodies were faster from a step to its end,
//   - d(sum dt F)/dV = sum_k sum_i m J_i^T (b_i g_i g_i^T + c_i 1) J_i,
// of which the diagonal is kept. Parts are those of body_answer.cl, in which spins count as speeds
// at the body's lever. Films push them, too (body_film.cl).

#include "sim-server/fluid/boundary/six.h"
#include "sim-server/fluid/params/fluid_params.h"

// One work-item for each body. `sums`: of each, six of the one and six of the other [N s], [kg],
// torques and inertias about its centre [N m s], [kg m2]. `film`: pushes of the films, for
// `pressed` seconds.
kernel void sum_pushes(int body_count, constant FreeBody* bodies, global const float* parts,
                       float pressed, global const float* film, global float* sums) {
  const int b = get_global_id(0);
  if (b >= body_count) return;
  const float size = bodies[b].size;
  for (int e = 0; e < 6; ++e) {
    const int square = 6 + SIX_AT(e, e);
    float push = 0.0f, yield = 0.0f;
    for (int part = 0; part < SPLASH_PUSH_PARTS; ++part) {
      global const float* one = parts + (b * SPLASH_PUSH_PARTS + part) * SPLASH_PUSH_ENTRIES;
      push += one[e];
      yield += one[square];
    }
    sums[12 * b + e] += e < 3 ? push : size * push;
    if (pressed > 0.0f) sums[12 * b + e] += pressed * film[6 * b + e];
    sums[12 * b + 6 + e] += e < 3 ? yield : size * size * yield;
  }
}
