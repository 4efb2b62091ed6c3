// SPDX-License-Identifier: MIT
// One neighbour as all lanes of a group see it.

#include "sim-server/fluid/lanes/lanes.h"
#include "sim-server/fluid/neighbours/group.h"
#include "sim-server/fluid/params/fluid_params.h"
#include "sim-server/fluid/params/smoothing.h"

typedef struct {
  lanes dx, dy, dz;  // from the neighbour to the particle [m]
  lanes r2;          // their distance squared [m2]
  lanes slope;       // grad W = -gradient_norm slope x
} Pair;

static Pair pair_with(constant FluidParams* p, const Group* g, global const float* position,
                      int stride, int j) {
  Pair pair;
  pair.dx = g->x - position[j];
  pair.dy = g->y - position[stride + j];
  pair.dz = g->z - position[2 * stride + j];
  pair.r2 = pair.dx * pair.dx + pair.dy * pair.dy + pair.dz * pair.dz;
  pair.slope = kernel_slope(pair.r2, p->inverse_support);
  return pair;
}

// The viscous law of a pair (Monaghan 2005, sections 4 and 5), for water against water and bodies:
//   (10 nu v.x + alpha c0 h min(v.x, 0)) / (r^2 + 0.01 h^2)         v, x: of one less the other's
// as what approaches rubs more. The factors are given as they are, or over rho0.

// v . x of a pair whose one is as fast as `u`, `v` and `w` and whose other is number `j` [m2/s].
static lanes closing_with(const Pair* pair, lanes u, lanes v, lanes w,
                          global const float* velocity, int stride, int j) {
  return (u - velocity[j]) * pair->dx + (v - velocity[stride + j]) * pair->dy +
         (w - velocity[2 * stride + j]) * pair->dz;
}

static lanes rubbing(float viscous, float artificial, lanes closing) {
  return viscous * closing + artificial * fmin(closing, 0.0f);
}

// 1 / (r^2 + 0.01 h^2)
static lanes inverse_square(constant FluidParams* p, const Pair* pair) {
  const float eta2 = 0.01f * p->length * p->length;
  return inverse(pair->r2 + eta2);
}
