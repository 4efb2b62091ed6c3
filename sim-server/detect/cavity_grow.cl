// SPDX-License-Identifier: MIT
// The extent of cavities (paper, section 5.3.2): bubbles surrounded by bubbles are seeds; in each
// round every bubble takes the smallest label among itself and its neighbours within the support,
// until no label changes.

#include "sim-server/detect/bubble_state.h"
#include "sim-server/fluid/neighbours/grid.h"
#include "sim-server/fluid/params/fluid_params.h"

kernel void seed_cavities(int bubble_count, float least_colour, global const BubbleState* state,
                          global int* label) {
  const int i = get_global_id(0);
  if (i < bubble_count) label[i] = state[i].colour > least_colour ? i : SPLASH_UNLABELLED;
}

kernel void grow_cavities(constant FluidParams* p, global const int* bubble_start,
                          global const float* position, int stride, int bubble_count,
                          global const int* label, global int* grown, global int* changed) {
  const int i = get_global_id(0);
  if (i >= bubble_count) return;
  const float x = position[i], y = position[stride + i], z = position[2 * stride + i];
  const int row = cell_row(p, y, z);
  const int slice = slice_x(p, x);
  const float reach2 = p->support * p->support;
  int smallest = label[i];
  for (int k = 0; k < 9; ++k) {
    const int2 run = neighbour_run(p, bubble_start, row, slice, slice, k);
    for (int j = run.x; j < run.y; ++j) {
      const float dx = x - position[j];
      const float dy = y - position[stride + j];
      const float dz = z - position[2 * stride + j];
      if (dx * dx + dy * dy + dz * dz < reach2) smallest = min(smallest, label[j]);
    }
  }
  grown[i] = smallest;
  if (smallest != label[i]) *changed = 1;
}
