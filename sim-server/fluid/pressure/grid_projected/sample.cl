// SPDX-License-Identifier: MIT
// The grid's pressures at the particles, for whoever asks for a particle's: the mean of the cells
// with water around it, each carried to its place as in water at rest. Before, the state
// equation's, which spacing needs, is laid aside.

#include "sim-server/fluid/params/fluid_params.h"
#include "sim-server/fluid/pressure/grid_projected/mac_cell.h"
#include "sim-server/fluid/pressure/grid_projected/mac_grid.h"

kernel void sample_pressure(constant FluidParams* p, constant MacGrid* g,
                            global const float* position, global const float* density,
                            global const int* flags, global const float* pressure,
                            global float* term, global float* spacing_term) {
  const int i = get_global_id(0);
  if (i >= p->count) return;
  spacing_term[i] = term[i];
  const int n = p->capacity;
  const float x = position[i], y = position[n + i], z = position[2 * n + i];
  const Placed at = place_on_grid(g, x, y, z);
  const Around a = around(g, &at, 3);
  float sum = 0.0f, weight = 0.0f;
  for (int k = 0; k < 8; ++k) {
    if ((flags[a.cell[k]] & MAC_FLUID) == 0) continue;
    const bool ux = k & 1, uy = k & 2, uz = k & 4;
    const float dx = x - g->x - ((ux ? at.middle[0].upper : at.middle[0].lower) + 0.5f) * g->hx;
    const float dy = y - g->y - ((uy ? at.middle[1].upper : at.middle[1].lower) + 0.5f) * g->hy;
    const float dz = z - g->z - ((uz ? at.middle[2].upper : at.middle[2].lower) + 0.5f) * g->hz;
    const float fx = p->gravity_x - p->pull_x * (x - p->centre_x);
    const float fy = p->gravity_y - p->pull_y * (y - p->centre_y);
    const float fz = p->gravity_z - p->pull_z * (z - p->centre_z);
    sum += a.weight[k] *
           (pressure[a.cell[k]] + p->rest_density * (fx * dx + fy * dy + fz * dz));
    weight += a.weight[k];
  }
  const float mean = weight > 0.0f && at.on_grid ? fmax(sum / weight, 0.0f) : 0.0f;
  term[i] = mean / (density[i] * density[i]);
}
