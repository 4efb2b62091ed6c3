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
