// SPDX-License-Identifier: MIT
// Faces beside water get what the pressures do to them, walls stop: what the step changed at each
// face is left in `pushed`, or MAC_UNKNOWN where there is no water, or a solid closes the face.
// Then the pressures of cells with water are kept, in Pa.

#include "sim-server/fluid/params/fluid_params.h"
#include "sim-server/fluid/pressure/grid_projected/mac_cell.h"
#include "sim-server/fluid/pressure/grid_projected/mac_grid.h"
#include "sim-server/fluid/pressure/grid_projected/room.h"
#include "sim-server/fluid/pressure/grid_projected/surface.h"

// How fast f grows across the lower face of a cell along an axis [edges].
static float growth(global const float* fill, global const float* wet, global const float* found,
                    int c, int below) {
  const bool here = wet[c] > 0.0f, there = wet[below] > 0.0f;
  if (here && there) return found[c] - found[below];
  if (here) return found[c] / way_to_surface(fill[c], fill[below]);
  return -found[below] / way_to_surface(fill[below], fill[c]);
}


kernel void project_faces(constant FluidParams* p, constant MacGrid* g, float dt,
                          global const float* gap, global const float* fill,
                          global const float* mean, global const float* weight,
                          global const float* found, global const float* wet,
                          global float* pushed, global float* pressure) {
  const int4 at = cell_of(g, get_global_id(0));
  if (at.w == 0) return;
  const MacLevel l = g->level[0];
  const int c = number_of(l, at);
  const int step[3] = {1, l.row, l.layer};
  const float inverse[3] = {g->ix, g->iy, g->iz};
  for (int axis = 0; axis < 3; ++axis) {
    const int below = c - step[axis], face = axis * l.cells + c;
    const bool wall = is_wall(l, at, axis);
    float change = MAC_UNKNOWN;
    const bool open = open_of(gap, face) > 0.0f && (wall || wet[c] + wet[below] > 0.0f);
    if (weight[face] > MAC_LIGHT && open) {
      change = pushed[face] - mean[face];
      if (!wall) change -= growth(fill, wet, found, c, below) * inverse[axis];
    }
    pushed[face] = change;
  }
  pressure[c] = wet[c] * found[c] * p->rest_density / dt;
}
