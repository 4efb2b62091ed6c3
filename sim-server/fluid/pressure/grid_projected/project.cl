// SPDX-License-Identifier: MIT
// Faces that the pressures are known for get what these do to them; what the step changed at each
// face is left in `pushed`. Walls stop. Then the pressures of cells with water are kept, in Pa.

#include "sim-server/fluid/params/fluid_params.h"
#include "sim-server/fluid/pressure/grid_projected/mac_cell.h"
#include "sim-server/fluid/pressure/grid_projected/mac_grid.h"

kernel void project_faces(constant FluidParams* p, constant MacGrid* g, float dt,
                          global const float* fill, global const float* mean,
                          global const float* weight, global const float* found,
                          global float* pushed, global int* flags, global float* pressure) {
  const int4 at = cell_of(g, get_global_id(0));
  if (at.w == 0) return;
  const MacLevel l = g->level[0];
  const int c = number_of(l, at);
  const int step[3] = {1, l.row, l.layer};
  const float edge[3] = {g->hx, g->hy, g->hz};
  const bool fluid = (flags[c] & MAC_FLUID) != 0;
  int known = fluid ? MAC_FLUID : 0;
  for (int axis = 0; axis < 3; ++axis) {
    const int below = c - step[axis], face = axis * l.cells + c;
    const bool water_below = fill[below] > MAC_FULL;
    float u = pushed[face];
    if (is_wall(l, at, axis)) {
      known |= MAC_FACE(axis);
    } else if (fluid || water_below) {
      float slope;
      if (fluid && water_below) {
        slope = found[c] - found[below];
      } else if (fluid) {
        slope = found[c] / way_to_surface(fill[c], fill[below]);
      } else {
        slope = -found[below] / way_to_surface(fill[below], fill[c]);
      }
      u -= slope / edge[axis];
      known |= MAC_FACE(axis);
    }
    if (!(weight[face] > MAC_LIGHT)) known &= ~MAC_FACE(axis);
    pushed[face] = u - mean[face];
  }
  flags[c] = known;
  pressure[c] = fluid ? found[c] * p->rest_density / dt : 0.0f;
}
