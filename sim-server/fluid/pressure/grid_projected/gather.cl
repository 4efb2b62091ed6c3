// SPDX-License-Identifier: MIT
// Particles to faces on GPUs (on CPUs: scatter.cl): of each face the mean of the particles around
// it, weighed by the hat, and of each cell how full it is. One work-item for a cell with its lower
// faces looks through the sorted particles near it. No atomics: the same bits on every run.

#include "sim-server/fluid/lanes/lanes.h"
#include "sim-server/fluid/neighbours/grid.h"
#include "sim-server/fluid/params/fluid_params.h"
#include "sim-server/fluid/pressure/grid_projected/mac_cell.h"
#include "sim-server/fluid/pressure/grid_projected/mac_grid.h"

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

// Adds the particles of a run to the sums of the cell `at`.
static void gather_run(constant FluidParams* p, constant MacGrid* g, int4 at, int2 run,
                       global const float* position, global const float* value, Gathered* sums) {
  const int n = p->capacity;
  const MacLevel l = g->level[0];
  const lanes none = 0.0f;
  for (int j = run.x; j < run.y; j += LANES) {
    const lanes x = load_x(position, j, run.y);
    const lanes y = LOAD(position + n, j), z = LOAD(position + 2 * n, j);
    // Lanes past the run's end are far away, where the last cell's hat would still be whole.
    const lane_flags here = x < (lanes)(0.5f * FAR_AWAY);
    const lanes mx = hat_of_middle(x, g->x, g->ix, at.x, l.nx, true);
    const lanes my = hat_of_middle(y, g->y, g->iy, at.y, l.ny, true);
    const lanes mz = select(none, hat_of_middle(z, g->z, g->iz, at.z, l.nz, false), here);
    const lanes fz = select(none, hat_of_face(z, g->z, g->iz, at.z), here);
    const lanes weight[3] = {hat_of_face(x, g->x, g->ix, at.x) * my * mz,
                             mx * hat_of_face(y, g->y, g->iy, at.y) * mz, mx * my * fz};
    for (int axis = 0; axis < 3; ++axis) {
      sums->sum[axis] += weight[axis] * LOAD(value + axis * n, j);
      sums->weight[axis] += weight[axis];
    }
    sums->fill += mx * my * mz;
  }
}

static void gather(constant FluidParams* p, constant MacGrid* g, int4 at,
                   global const int* cell_start, global const float* position,
                   global const float* value, Gathered* sums) {
  const float3 edge = (float3)(g->hx, g->hy, g->hz);
  const float3 low = (float3)(g->x, g->y, g->z) + edge * (float3)(at.x, at.y, at.z);
  const RowBox box = rows_of_box(p, low - edge, low + 1.5f * edge);
  const int layer = p->cells_y * p->cells_x * SLICES;
  if (cell_start[box.low_z * layer] == cell_start[(box.high_z + 1) * layer]) {
    return;  // nothing is this high
  }
  for (int z = box.low_z; z <= box.high_z; ++z) {
    for (int y = box.low_y; y <= box.high_y; ++y) {
      gather_run(p, g, at, run_of_row(p, cell_start, box, y, z), position, value, sums);
    }
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
  Gathered sums = {{0.0f, 0.0f, 0.0f}, {0.0f, 0.0f, 0.0f}, 0.0f};
  gather(p, g, at, cell_start, position, value, &sums);
  const int c = number_of(l, at);
  for (int axis = 0; axis < 3; ++axis) {
    const float w = total(sums.weight[axis]);
    weight[axis * l.cells + c] = w;
    mean[axis * l.cells + c] = w > MAC_LIGHT ? total(sums.sum[axis]) / w : 0.0f;
  }
  const bool inside = at.x < l.nx && at.y < l.ny && at.z < l.nz;
  fill[c] = inside ? g->share * total(sums.fill) : 0.0f;
}
