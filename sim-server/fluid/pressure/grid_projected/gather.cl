// SPDX-License-Identifier: MIT
// Particles to faces: of each face the mean of the particles around it, weighed by the hat, and of
// each cell how full it is. One work-item for a strip of cells along x, with their lower faces,
// looks through the sorted particles near them: no atomics, the same bits on every run.

#include "sim-server/fluid/lanes/lanes.h"
#include "sim-server/fluid/neighbours/grid.h"
#include "sim-server/fluid/params/fluid_params.h"
#include "sim-server/fluid/pressure/grid_projected/mac_cell.h"
#include "sim-server/fluid/pressure/grid_projected/mac_grid.h"

#if LANES > 1
#define STRIP 2  // cells
#else
#define STRIP 1
#endif


// Weights of particles along one axis: for the place of the cell's lower face and for its middle,
// where the first and last cell's hats go on to the wall; past the last there is none.
static lanes hat_of_face(lanes x, float from, float inverse, int i) {
  return fmax(1.0f - fabs((x - from) * inverse - i), 0.0f);
}

static lanes hat_of_middle(lanes x, float from, float inverse, int i, int n, bool mirrored) {
  if (i == n) return 0.0f;
  lanes d = (x - from) * inverse - (i + 0.5f);
  if (i == 0) d = fmax(d, 0.0f);
  if (mirrored && i == n - 1) d = fmin(d, 0.0f);
  return fmax(1.0f - fabs(d), 0.0f);
}

typedef struct {
  lanes weight[3], sum[3], fill;
} Gathered;

// Adds the particles of a run to the cells of a strip that begins with `at`. `anew`: weights, too.
static void gather_run(constant FluidParams* p, constant MacGrid* g, int4 at, int2 run, bool anew,
                       global const float* position, global const float* value, Gathered* sums) {
  const int n = p->capacity;
  const MacLevel l = g->level[0];
  const lanes none = 0.0f;
  for (int j = run.x; j < run.y; j += LANES) {
    const lanes x = load_x(position, j, run.y);
    const lanes y = LOAD(position + n, j), z = LOAD(position + 2 * n, j);
    const lanes u = LOAD(value, j), v = LOAD(value + n, j), w = LOAD(value + 2 * n, j);
    // Lanes past the run's end are far away, where the last cell's hat would still be whole.
    const lanes mz = select(none, hat_of_middle(z, g->z, g->iz, at.z, l.nz, false),
                            x < (lanes)(0.5f * FAR_AWAY));
    const lanes fz = select(none, hat_of_face(z, g->z, g->iz, at.z),
                            x < (lanes)(0.5f * FAR_AWAY));
    const lanes my = hat_of_middle(y, g->y, g->iy, at.y, l.ny, true);
    const lanes across_x = my * mz, across_y = hat_of_face(y, g->y, g->iy, at.y) * mz,
                across_z = my * fz;
    for (int k = 0; k < STRIP; ++k) {
      const lanes mx = hat_of_middle(x, g->x, g->ix, at.x + k, l.nx, true);
      const lanes wx = hat_of_face(x, g->x, g->ix, at.x + k) * across_x;
      const lanes wy = mx * across_y, wz = mx * across_z;
      sums[k].sum[0] += wx * u;
      sums[k].sum[1] += wy * v;
      sums[k].sum[2] += wz * w;
      if (!anew) continue;
      sums[k].weight[0] += wx;
      sums[k].weight[1] += wy;
      sums[k].weight[2] += wz;
      sums[k].fill += mx * across_x;
    }
  }
}

static void gather(constant FluidParams* p, constant MacGrid* g, bool anew, int4 at,
                   global const int* cell_start, global const float* position,
                   global const float* value, Gathered* sums) {
  const float x = g->x + at.x * g->hx, y = g->y + at.y * g->hy, z = g->z + at.z * g->hz;
  const int from = slice_x(p, x - g->hx), to = slice_x(p, x + (STRIP + 0.5f) * g->hx);
  const int low_y = cell_along(y - g->hy, p->origin_y, p->inverse_cell, p->cells_y);
  const int high_y = cell_along(y + 1.5f * g->hy, p->origin_y, p->inverse_cell, p->cells_y);
  const int low_z = cell_along(z - g->hz, p->origin_z, p->inverse_cell, p->cells_z);
  const int high_z = cell_along(z + 1.5f * g->hz, p->origin_z, p->inverse_cell, p->cells_z);
  const int rows = p->cells_x * SLICES;
  // Nothing is this high.
  if (cell_start[low_z * p->cells_y * rows] == cell_start[(high_z + 1) * p->cells_y * rows]) return;
  for (int row_z = low_z; row_z <= high_z; ++row_z) {
    for (int row_y = low_y; row_y <= high_y; ++row_y) {
      const int base = (row_z * p->cells_y + row_y) * rows;
      const int2 run = (int2)(cell_start[base + from], cell_start[base + to + 1]);
      gather_run(p, g, at, run, anew, position, value, sums);
    }
  }
}

// First cell of strip number `item` of those inside and, along each axis, the one above them; the
// last: whether there is one.
static int4 strip_of(constant MacGrid* g, int item) {
  const MacLevel l = g->level[0];
  const int across = l.nx / STRIP + 1, along = l.ny + 1;
  const int layer = item / (across * along);
  return (int4)(item % across * STRIP, item / across % along, layer, layer <= l.nz);
}

// `value`: of each particle, x, y and z. `mean`, `weight`: of the faces, likewise.
kernel void gather_faces(constant FluidParams* p, constant MacGrid* g,
                         global const int* cell_start, global const float* position,
                         global const float* value, global float* mean, global float* weight,
                         global float* fill) {
  const int4 at = strip_of(g, get_global_id(0));
  if (at.w == 0) return;
  const MacLevel l = g->level[0];
  Gathered sums[STRIP];
  const Gathered none = {{0.0f, 0.0f, 0.0f}, {0.0f, 0.0f, 0.0f}, 0.0f};
  for (int k = 0; k < STRIP; ++k) sums[k] = none;
  gather(p, g, true, at, cell_start, position, value, sums);
  for (int k = 0; k < STRIP && at.x + k <= l.nx; ++k) {
    const int c = number_of(l, at) + k;
    for (int axis = 0; axis < 3; ++axis) {
      const float w = total(sums[k].weight[axis]);
      weight[axis * l.cells + c] = w;
      mean[axis * l.cells + c] = w > MAC_LIGHT ? total(sums[k].sum[axis]) / w : 0.0f;
    }
    const bool inside = at.x + k < l.nx && at.y < l.ny && at.z < l.nz;
    fill[c] = inside ? g->share * total(sums[k].fill) : 0.0f;
  }
}

// The same of another value, where the weights are known.
kernel void gather_again(constant FluidParams* p, constant MacGrid* g,
                         global const int* cell_start, global const float* position,
                         global const float* value, global const float* weight,
                         global float* mean) {
  const int4 at = strip_of(g, get_global_id(0));
  if (at.w == 0) return;
  const MacLevel l = g->level[0];
  Gathered sums[STRIP];
  const Gathered none = {{0.0f, 0.0f, 0.0f}, {0.0f, 0.0f, 0.0f}, 0.0f};
  for (int k = 0; k < STRIP; ++k) sums[k] = none;
  gather(p, g, false, at, cell_start, position, value, sums);
  for (int k = 0; k < STRIP && at.x + k <= l.nx; ++k) {
    for (int axis = 0; axis < 3; ++axis) {
      const int face = axis * l.cells + number_of(l, at) + k;
      mean[face] = weight[face] > MAC_LIGHT ? total(sums[k].sum[axis]) / weight[face] : 0.0f;
    }
  }
}
