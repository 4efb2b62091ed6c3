// SPDX-License-Identifier: MIT
// The grid's pressures at the particles, for whoever asks for a particle's: the mean of the cells
// with water around it, each carried to its place as in water at rest.

#include "sim-server/fluid/lanes/lanes.h"
#include "sim-server/fluid/params/fluid_params.h"
#include "sim-server/fluid/pressure/grid_projected/mac_cell.h"
#include "sim-server/fluid/pressure/grid_projected/mac_grid.h"

// `wet`: 1 where a cell holds water. `term`: p / rho^2.
kernel void sample_pressure(constant FluidParams* p, constant MacGrid* g,
                            global const float* position, global const float* density,
                            global const float* wet, global const float* pressure,
                            global float* term) {
  const int n = p->capacity;
  const int i = get_global_id(0) * LANES;
  if (i >= p->count) return;
  const lanes x = LOAD(position, i), y = LOAD(position + n, i), z = LOAD(position + 2 * n, i);
  const Placed at = place_on_grid(g, x, y, z);
  const Around a = around(g, &at, 3);
  lanes holds[8], presses[8];
  load_around(&a, wet, holds);
  load_around(&a, pressure, presses);
  // From the first of the middles around.
  const lanes dx = x - g->x - (at.middle[0].lower + 0.5f) * g->hx;
  const lanes dy = y - g->y - (at.middle[1].lower + 0.5f) * g->hy;
  const lanes dz = z - g->z - (at.middle[2].lower + 0.5f) * g->hz;
  const lanes fx = p->rest_density * (p->gravity_x - p->pull_x * (x - p->centre_x));
  const lanes fy = p->rest_density * (p->gravity_y - p->pull_y * (y - p->centre_y));
  const lanes fz = p->rest_density * (p->gravity_z - p->pull_z * (z - p->centre_z));
  lanes sum = 0.0f, weight = 0.0f;
  for (int k = 0; k < 8; ++k) {
    const lanes w = holds[k] * a.weight[k];
    sum += w * (presses[k] + fx * (dx - (k & 1 ? g->hx : 0.0f)) +
                fy * (dy - (k & 2 ? g->hy : 0.0f)) + fz * (dz - (k & 4 ? g->hz : 0.0f)));
    weight += w;
  }
  const lanes none = 0.0f;
  const lanes rho = LOAD(density, i);
  const lanes mean = fmax(sum / fmax(weight, (lanes)(MAC_LIGHT)), none);
  STORE(select(none, mean / (rho * rho), at.on_grid & (weight > none)), term, i);
}
