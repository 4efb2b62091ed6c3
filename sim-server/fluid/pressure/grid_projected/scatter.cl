// SPDX-License-Identifier: MIT
// Particles to faces on CPUs (on GPUs: gather.cl): each of a few work-items goes through a run of
// sorted particles and adds each to the places around it, in a grid of its own; these are added up
// in a fixed order. No atomics: the same bits on every run.

#include "sim-server/fluid/lanes/lanes.h"
#include "sim-server/fluid/params/fluid_params.h"
#include "sim-server/fluid/pressure/grid_projected/mac_cell.h"
#include "sim-server/fluid/pressure/grid_projected/mac_grid.h"

#define REACH 3  // places along an axis that hold all faces and middles around a particle

// Eight numbers stand at each place of a work-item's grid: the particles' values, weighed, on the
// faces along x, y and z; the weights there; that of the cell; nothing. These are the faces among
// them.
#define FACES_X ((int8)(-1, 0, 0, -1, 0, 0, 0, 0))
#define FACES_Y ((int8)(0, -1, 0, 0, -1, 0, 0, 0))
#define FACES_Z ((int8)(0, 0, -1, 0, 0, -1, 0, 0))

// How many places such a grid has: particles in a tank of one cell reach beyond those around it.
static int places_of(const MacLevel l) { return l.cells + 2 * l.layer; }

// Weights of particles along one axis, for the faces and the middles of the cells from `lower` on.
typedef struct {
  lanes lower;
  lanes face[REACH], middle[REACH];
} Hats;

static Hats hats_along(lanes x, float from, float inverse, int n, bool mirrored) {
  const lanes none = 0.0f, at = (x - from) * inverse;
  const lanes middle = within(at - 0.5f, 0.0f, mirrored ? n - 1.0f : FAR_AWAY);
  Hats h;
  h.lower = within(floor(at - 0.5f), 0.0f, max(n - 2, 0));
  for (int k = 0; k < REACH; ++k) {
    const lanes place = h.lower + k;
    h.face[k] = fmax(1.0f - fabs(at - place), none);
    h.middle[k] = select(fmax(1.0f - fabs(middle - place), none), none, place > (lanes)(n - 0.5f));
  }
  return h;
}

// Of LANES particles, one by one.
typedef struct {
  int first[LANES];
  float face[3][REACH][LANES], middle[3][REACH][LANES], value[3][LANES];
} Scattered;

static void lay_out(constant MacGrid* g, int n, global const float* position,
                    global const float* value, int i, Scattered* s) {
  const MacLevel l = g->level[0];
  const Hats along[3] = {
      hats_along(LOAD(position, i), g->x, g->ix, l.nx, true),
      hats_along(LOAD(position + n, i), g->y, g->iy, l.ny, true),
      hats_along(LOAD(position + 2 * n, i), g->z, g->iz, l.nz, false)};
  STORE((WHOLE(along[2].lower) + 1) * l.layer + (WHOLE(along[1].lower) + 1) * l.row +
            WHOLE(along[0].lower) + 1,
        s->first, 0);
  for (int axis = 0; axis < 3; ++axis) {
    STORE(LOAD(value + axis * n, i), s->value[axis], 0);
    for (int k = 0; k < REACH; ++k) {
      STORE(along[axis].face[k], s->face[axis][k], 0);
      STORE(along[axis].middle[k], s->middle[axis][k], 0);
    }
  }
}

static float8 weights_at(const Scattered* s, int axis, int k, int lane, int8 faces) {
  return select((float8)(s->middle[axis][k][lane]), (float8)(s->face[axis][k][lane]), faces);
}

static void scatter_one(const MacLevel l, const Scattered* s, int lane, global float8* grid) {
  const float8 value = (float8)(s->value[0][lane], s->value[1][lane], s->value[2][lane], 1.0f, 1.0f,
                                1.0f, 1.0f, 0.0f);
  float8 along_x[REACH], along_y[REACH];
#pragma unroll
  for (int k = 0; k < REACH; ++k) {
    along_x[k] = weights_at(s, 0, k, lane, FACES_X);
    along_y[k] = weights_at(s, 1, k, lane, FACES_Y);
  }
  global float8* at = grid + s->first[lane];
#pragma unroll
  for (int z = 0; z < REACH; ++z) {
    const float8 in_layer = value * weights_at(s, 2, z, lane, FACES_Z);
#pragma unroll
    for (int y = 0; y < REACH; ++y) {
      const float8 in_row = in_layer * along_y[y];
      global float8* row = at + z * l.layer + y * l.row;
#pragma unroll
      for (int x = 0; x < REACH; ++x) row[x] += in_row * along_x[x];
    }
  }
}

// `value`: of each particle, x, y and z. `grids`: one for each work-item; `layers`: the first and
// last that it reached.
kernel void scatter_to_faces(constant FluidParams* p, constant MacGrid* g, int items,
                             global const float* position, global const float* value,
                             global float* grids, global int* layers) {
  const int item = get_global_id(0);
  if (item >= items) return;
  const MacLevel l = g->level[0];
  const int n = p->capacity;
  const int size = ((p->count + items - 1) / items + LANES - 1) / LANES * LANES;
  const int first = item * size, last = min(first + size, p->count);
  lanes low = l.nz, high = 0.0f;
  for (int i = first; i < last; i += LANES) {
    const lanes lower = hats_along(LOAD(position + 2 * n, i), g->z, g->iz, l.nz, false).lower;
    const lane_flags here = LANE_NUMBERS < (lane_flags)(last - i);
    low = select(low, fmin(low, lower), here);
    high = select(high, fmax(high, lower), here);
  }
  const int2 reached = (int2)((int)least(low), (int)most(high) + REACH - 1);
  vstore2(reached, item, layers);
  global float8* grid = (global float8*)grids + (size_t)item * places_of(l);
  for (int c = (reached.x + 1) * l.layer; c < (reached.y + 2) * l.layer; ++c) grid[c] = 0.0f;
  for (int i = first; i < last; i += LANES) {
    Scattered s;
    lay_out(g, n, position, value, i, &s);
    for (int lane = 0; lane < LANES && i + lane < last; ++lane) scatter_one(l, &s, lane, grid);
  }
}

#define NUMBERS 8  // at each place of a grid

// Turns what LANES places hold, place after place, into a vector for each number.
static void turn_round(lanes a[NUMBERS]) {
#if LANES > 1
  lanes b[NUMBERS];
  for (int turn = 0; turn < 3; ++turn) {
    for (int k = 0; k < NUMBERS / 2; ++k) {
      b[k] = (lanes)(a[2 * k].even, a[2 * k + 1].even);
      b[k + NUMBERS / 2] = (lanes)(a[2 * k].odd, a[2 * k + 1].odd);
    }
    for (int k = 0; k < NUMBERS; ++k) a[k] = b[k];
  }
#endif
}

// A vector of cells with their lower faces: `mean` and `weight` of the faces, x, y and z.
kernel void add_up_faces(constant MacGrid* g, int items, global const float* grids,
                         global const int* layers, global float* mean, global float* weight,
                         global float* fill) {
  const MacLevel l = g->level[0];
  const Cells at = cells_of(g, get_global_id(0));
  if (at.z > l.nz) return;
  lanes sums[NUMBERS];
  for (int k = 0; k < NUMBERS; ++k) sums[k] = 0.0f;
  for (int item = 0; item < items; ++item) {
    const int2 reached = vload2(item, layers);
    if (at.z < reached.x || at.z > reached.y) continue;
    global const float* grid = grids + NUMBERS * ((size_t)item * places_of(l) + at.first);
    for (int k = 0; k < NUMBERS; ++k) sums[k] += LOAD(grid, k * LANES);
  }
  turn_round(sums);
  const lanes none = 0.0f;
  for (int axis = 0; axis < 3; ++axis) {
    const lanes w = select(none, sums[3 + axis], at.real);
    STORE(w, weight + axis * l.cells, at.first);
    STORE(select(none, sums[axis] / w, w > (lanes)(MAC_LIGHT)), mean + axis * l.cells, at.first);
  }
  STORE(select(none, g->share * sums[6], at.inside), fill, at.first);
}
