// SPDX-License-Identifier: MIT
// Particles to faces: of each face the mean of the particles around it, weighed by the hat, and of
// each cell how full it is. One work-item for a cell and its three lower faces looks through the
// sorted particles near them: no atomics, the same bits on every run.

#include "sim-server/fluid/lanes/lanes.h"
#include "sim-server/fluid/neighbours/grid.h"
#include "sim-server/fluid/params/fluid_params.h"
#include "sim-server/fluid/pressure/grid_projected/mac_cell.h"
#include "sim-server/fluid/pressure/grid_projected/mac_grid.h"

// Weights of particles along one axis: for the place of the cell's lower face and for its middle,
// where the first and last cell's hats go on to the wall.
static lanes hat_of_face(lanes x, float from, float inverse, int i) {
  return fmax(1.0f - fabs((x - from) * inverse - i), 0.0f);
}

static lanes hat_of_middle(lanes x, float from, float inverse, int i, bool first, bool last) {
  lanes d = (x - from) * inverse - (i + 0.5f);
  if (first) d = fmax(d, 0.0f);
  if (last) d = fmin(d, 0.0f);
  return fmax(1.0f - fabs(d), 0.0f);
}

typedef struct {
  lanes weight[3], sum[3], fill;
} Gathered;

static void gather_run(constant FluidParams* p, constant MacGrid* g, int4 at, int2 run,
                       global const float* position, global const float* value, Gathered* sums) {
  const int n = p->capacity;
  const MacLevel l = g->level[0];
  const float ix = 1.0f / g->hx, iy = 1.0f / g->hy, iz = 1.0f / g->hz;
  for (int j = run.x; j < run.y; j += LANES) {
    const lanes x = load_x(position, j, run.y);
    const lanes y = LOAD(position + n, j), z = LOAD(position + 2 * n, j);
    const lanes fx = hat_of_face(x, g->x, ix, at.x), fy = hat_of_face(y, g->y, iy, at.y),
                fz = hat_of_face(z, g->z, iz, at.z);
    const lanes none = 0.0f;
    // Lanes past the run's end are far away, where the last cell's hat would still be whole.
    const lanes mx = select(none, hat_of_middle(x, g->x, ix, at.x, at.x == 0, at.x == l.nx - 1),
                            x < (lanes)(0.5f * FAR_AWAY));
    const lanes my = hat_of_middle(y, g->y, iy, at.y, at.y == 0, at.y == l.ny - 1);
    const lanes mz = hat_of_middle(z, g->z, iz, at.z, at.z == 0, false);
    const lanes wx = fx * my * mz, wy = mx * fy * mz, wz = mx * my * fz;
    sums->weight[0] += wx;
    sums->weight[1] += wy;
    sums->weight[2] += wz;
    sums->sum[0] += wx * LOAD(value, j);
    sums->sum[1] += wy * LOAD(value + n, j);
    sums->sum[2] += wz * LOAD(value + 2 * n, j);
    sums->fill += mx * my * mz;
  }
}

// `value`: of each particle, x, y and z. `mean`, `weight`: of the faces, likewise.
kernel void gather_faces(constant FluidParams* p, constant MacGrid* g,
                         global const int* cell_start, global const float* position,
                         global const float* value, global float* mean, global float* weight,
                         global float* fill) {
  const int4 at = cell_of(g, get_global_id(0));
  if (at.w == 0) return;
  const MacLevel l = g->level[0];
  const int c = number_of(l, at);
  Gathered sums = {{0.0f, 0.0f, 0.0f}, {0.0f, 0.0f, 0.0f}, 0.0f};
  const float x = g->x + at.x * g->hx, y = g->y + at.y * g->hy, z = g->z + at.z * g->hz;
  const int from = slice_x(p, x - g->hx), to = slice_x(p, x + 1.5f * g->hx);
  const int low_y = cell_along(y - g->hy, p->origin_y, p->inverse_cell, p->cells_y);
  const int high_y = cell_along(y + 1.5f * g->hy, p->origin_y, p->inverse_cell, p->cells_y);
  const int low_z = cell_along(z - g->hz, p->origin_z, p->inverse_cell, p->cells_z);
  const int high_z = cell_along(z + 1.5f * g->hz, p->origin_z, p->inverse_cell, p->cells_z);
  const int rows = p->cells_x * SLICES;
  // Nothing is this high.
  if (cell_start[low_z * p->cells_y * rows] < cell_start[(high_z + 1) * p->cells_y * rows]) {
    for (int row_z = low_z; row_z <= high_z; ++row_z) {
      for (int row_y = low_y; row_y <= high_y; ++row_y) {
        const int base = (row_z * p->cells_y + row_y) * rows;
        const int2 run = (int2)(cell_start[base + from], cell_start[base + to + 1]);
        gather_run(p, g, at, run, position, value, &sums);
      }
    }
  }
  for (int axis = 0; axis < 3; ++axis) {
    const float w = total(sums.weight[axis]);
    weight[axis * l.cells + c] = w;
    mean[axis * l.cells + c] = w > MAC_LIGHT ? total(sums.sum[axis]) / w : 0.0f;
  }
  const bool inside = at.x < l.nx && at.y < l.ny && at.z < l.nz;
  fill[c] = inside ? g->share * total(sums.fill) : 0.0f;
}
