// SPDX-License-Identifier: MIT
// Cells and faces of the grid, and the hat by which they and the particles see each other: a
// particle counts to the places around it in proportion to how near they are, 1 - |d| / h along
// each axis. The lower face of a cell along an axis has the cell's number. Walls are mirrors: what
// is nearer to one than the middle of the last cell counts to that cell in full.

#include "sim-server/fluid/lanes/lanes.h"
#include "sim-server/fluid/params/fluid_params.h"
#include "sim-server/fluid/pressure/grid_projected/mac_grid.h"

#define MAC_LIGHT 1e-6f     // faces with less weight than this hold nothing [particles]
#define MAC_FULL 0.5f       // cells that are fuller than this hold water [1]
#define MAC_SEEN 1e-3f      // faces around a particle weigh this at least, or it falls freely [1]
#define MAC_UNKNOWN 1e30f   // what stands where a step found no change of a face's velocity
#define MAC_KNOWN 1e29f     // less is known

#if LANES == 16
#define WHOLE(a) convert_int16(a)
#define CONVERT(a) convert_float16(a)
#elif LANES == 8
#define WHOLE(a) convert_int8(a)
#define CONVERT(a) convert_float8(a)
#else
#define WHOLE(a) convert_int(a)
#define CONVERT(a) convert_float(a)
#endif

// What is no number becomes the least: no index leaves the arrays.
static lanes within(lanes a, float least, float most) {
  return fmin(fmax(a, (lanes)(least)), (lanes)(most));
}

// Where coordinates are between places along an axis: above which, and how far [1].
typedef struct {
  lanes lower, share;
} Between;

// On the faces, of which the last is number `n`.
static Between between_faces(lanes x, float from, float inverse, int n) {
  const lanes at = (x - from) * inverse;
  const lanes lower = within(floor(at), 0.0f, n - 1);
  const Between b = {lower, within(at - lower, 0.0f, 1.0f)};
  return b;
}

// On the middles of `n` cells between walls.
static Between between_middles(lanes x, float from, float inverse, int n) {
  const lanes at = within((x - from) * inverse - 0.5f, 0.0f, n - 1);
  const lanes lower = within(floor(at), 0.0f, max(n - 2, 0));
  const Between b = {lower, at - lower};
  return b;
}

// The lanes of a vector in another order, where that is one instruction.
#if (LANES == 16 && defined(__AVX512F__)) || (LANES == 8 && defined(__AVX2__))
#define PICKS
#if LANES == 16
#define PERMUTED __builtin_ia32_permvarsf512
#else
#define PERMUTED __builtin_ia32_permvarsf256
#endif
static lanes picked(lanes a, lane_flags which) {
  typedef float native __attribute__((__vector_size__(4 * LANES)));
  typedef int numbers __attribute__((__vector_size__(4 * LANES)));
  union {
    lanes f;
    native n;
  } from, to;
  union {
    lane_flags f;
    numbers n;
  } by;
  from.f = a;
  by.f = which;
  to.n = PERMUTED(from.n, by.n);
  return to.f;
}
#endif

// Particles among the places of the three faces, and of the middles.
typedef struct {
  Between face[3], middle[3];
  lane_flags on_grid;  // not above it
#ifdef PICKS
  int4 first[2], last[2];  // least and largest `lower` along each axis, of faces and of middles
#endif
} Placed;

static Placed place_on_grid(constant MacGrid* g, lanes x, lanes y, lanes z) {
  const MacLevel l = g->level[0];
  Placed at;
  at.face[0] = between_faces(x, g->x, g->ix, l.nx);
  at.face[1] = between_faces(y, g->y, g->iy, l.ny);
  at.face[2] = between_faces(z, g->z, g->iz, l.nz);
  at.middle[0] = between_middles(x, g->x, g->ix, l.nx);
  at.middle[1] = between_middles(y, g->y, g->iy, l.ny);
  at.middle[2] = between_middles(z, g->z, g->iz, l.nz);
  at.on_grid = z < (lanes)(g->z + g->hz * ((float)l.nz - 0.5f));
#ifdef PICKS
  for (int k = 0; k < 2; ++k) {
    const Between* b = k ? at.middle : at.face;
    at.first[k] = (int4)((int)least(b[0].lower), (int)least(b[1].lower), (int)least(b[2].lower), 0);
    at.last[k] = (int4)((int)most(b[0].lower), (int)most(b[1].lower), (int)most(b[2].lower), 0);
  }
#endif
  return at;
}

// The eight places around particles for the faces along an axis, or for the middles (3): the
// number of the first, how far it is to the others, and the weights.
typedef struct {
  lane_flags first;
  int x, y, z;
  lanes weight[8];
} Around;

static Around around(constant MacGrid* g, const Placed* at, int axis) {
  const MacLevel l = g->level[0];
  const Between bx = axis == 0 ? at->face[0] : at->middle[0];
  const Between by = axis == 1 ? at->face[1] : at->middle[1];
  const Between bz = axis == 2 ? at->face[2] : at->middle[2];
  Around a;
  a.x = axis == 0 || l.nx > 1 ? 1 : 0;
  a.y = axis == 1 || l.ny > 1 ? l.row : 0;
  a.z = axis == 2 || l.nz > 1 ? l.layer : 0;
  a.first = (WHOLE(bz.lower) + 1) * l.layer + (WHOLE(by.lower) + 1) * l.row + WHOLE(bx.lower) + 1;
  const lanes high = bz.share * by.share, deep = bz.share - high, low = by.share - high;
  const lanes rest = 1.0f - bz.share - low;
  a.weight[1] = rest * bx.share;
  a.weight[0] = rest - a.weight[1];
  a.weight[3] = low * bx.share;
  a.weight[2] = low - a.weight[3];
  a.weight[5] = deep * bx.share;
  a.weight[4] = deep - a.weight[5];
  a.weight[7] = high * bx.share;
  a.weight[6] = high - a.weight[7];
  return a;
}

// What stands there: x first, then y, then z.
static void load_around(const Around* a, global const float* field, lanes* value) {
#if LANES > 1
  int first[LANES];
  float part[8][LANES];
  STORE(a->first, first, 0);
  for (int lane = 0; lane < LANES; ++lane) {
    global const float* f = field + first[lane];
    part[0][lane] = f[0];
    part[1][lane] = f[a->x];
    part[2][lane] = f[a->y];
    part[3][lane] = f[a->y + a->x];
    part[4][lane] = f[a->z];
    part[5][lane] = f[a->z + a->x];
    part[6][lane] = f[a->z + a->y];
    part[7][lane] = f[a->z + a->y + a->x];
  }
  for (int k = 0; k < 8; ++k) value[k] = LOAD(part[k], 0);
#else
  global const float* f = field + a->first;
  for (int k = 0; k < 8; ++k) {
    value[k] = f[(k & 1 ? a->x : 0) + (k & 2 ? a->y : 0) + (k & 4 ? a->z : 0)];
  }
#endif
}

// Cell number `item` of those inside and, along each axis, the one above them; the last: whether
// there is one.
static int4 cell_of(constant MacGrid* g, int item) {
  const MacLevel l = g->level[0];
  const int across = l.nx + 1, along = l.ny + 1;
  const int layer = item / (across * along);
  return (int4)(item % across, item / across % along, layer, layer <= l.nz);
}

static int number_of(const MacLevel l, int4 at) {
  return (at.z + 1) * l.layer + (at.y + 1) * l.row + at.x + 1;
}

// A vector of cells of one layer: the number of the first, and where they are.
typedef struct {
  int first, z;
  lane_flags x, y;
  lane_flags real;  // inside, or above those inside along an axis
  lane_flags inside;
} Cells;

// Vector number `item`, from the lowest layer on.
static Cells cells_of(constant MacGrid* g, int item) {
  const MacLevel l = g->level[0];
  const int many = l.layer / LANES;
  Cells at;
  at.z = item / many;
  const int from = item % many * LANES;
  at.first = (at.z + 1) * l.layer + from;
  const lane_flags k = from + LANE_NUMBERS;
  // Exact: half a cell is farther from a whole row than rounding takes it.
  const lanes row = floor((lanes)(1.0f / l.row) * (CONVERT(k) + 0.5f));
  const lane_flags y = WHOLE(row);
  at.x = k - y * l.row - 1;
  at.y = y - 1;
  const lane_flags none = 0;
  at.real = (at.x >= none) & (at.x <= (lane_flags)(l.nx)) & (at.y >= none) &
            (at.y <= (lane_flags)(l.ny)) & ((lane_flags)(at.z) <= (lane_flags)(l.nz));
  at.inside = at.real & (at.x < (lane_flags)(l.nx)) & (at.y < (lane_flags)(l.ny)) &
              ((lane_flags)(at.z) < (lane_flags)(l.nz));
  return at;
}

// Acceleration from afar along an axis, at faces.
static lanes field_on_faces(constant FluidParams* p, constant MacGrid* g, const Cells* at,
                            int axis) {
  if (axis == 0) {
    return p->gravity_x - p->pull_x * (g->x + CONVERT(at->x) * g->hx - p->centre_x);
  }
  if (axis == 1) {
    return p->gravity_y - p->pull_y * (g->y + CONVERT(at->y) * g->hy - p->centre_y);
  }
  return (lanes)(p->gravity_z - p->pull_z * (g->z + at->z * g->hz - p->centre_z));
}

// Whether the lower faces of cells along an axis are walls. The tank has no upper wall.
static lane_flags are_walls(const MacLevel l, const Cells* at, int axis) {
  const lane_flags none = 0;
  if (axis == 0) return (at->x == none) | (at->x == (lane_flags)(l.nx));
  if (axis == 1) return (at->y == none) | (at->y == (lane_flags)(l.ny));
  return (lane_flags)(at->z) == none;
}

// Weighted sums over the eight faces along an axis that are around each particle. `whole`: of a
// field that is known on every face. `known`: of a field with gaps, over the faces where it is
// known; `weight`: of the weights of these.
typedef struct {
  lanes whole, known, weight;
} FaceSums;

static void add_faces(FaceSums* sums, lanes weight, lanes whole) { sums->whole += weight * whole; }

static void add_known(FaceSums* sums, lanes weight, lanes value) {
  const lanes w = select((lanes)(0.0f), weight, value < (lanes)(MAC_KNOWN));
  sums->known += w * value;
  sums->weight += w;
}

static FaceSums sum_by_place(constant MacGrid* g, const Placed* at, int axis,
                             global const float* whole, global const float* gappy) {
  const Around a = around(g, at, axis);
  FaceSums sums = {0.0f, 0.0f, 0.0f};
  lanes value[8];
  load_around(&a, whole, value);
  for (int k = 0; k < 8; ++k) add_faces(&sums, a.weight[k], value[k]);
  if (gappy == 0) return sums;
  load_around(&a, gappy, value);
  for (int k = 0; k < 8; ++k) add_known(&sums, a.weight[k], value[k]);
  return sums;
}

#ifdef PICKS
static lanes hat_at(Between b, int place) {
  return fmax(1.0f - fabs(b.lower - place + b.share), (lanes)(0.0f));
}

// The same, row by row of the box around all particles of a vector: each lane picks its two of a
// row's values.
static FaceSums sum_by_row(constant MacGrid* g, const Placed* at, int axis,
                           global const float* whole, global const float* gappy) {
  const MacLevel l = g->level[0];
  const Between bx = axis == 0 ? at->face[0] : at->middle[0];
  const Between by = axis == 1 ? at->face[1] : at->middle[1];
  const Between bz = axis == 2 ? at->face[2] : at->middle[2];
  const int x = at->first[axis != 0].x;
  const lane_flags lower = WHOLE(bx.lower) - x, upper = lower + 1;
  FaceSums sums = {0.0f, 0.0f, 0.0f};
  for (int z = at->first[axis != 2].z; z <= at->last[axis != 2].z + 1; ++z) {
    const lanes wz = hat_at(bz, z);
    for (int y = at->first[axis != 1].y; y <= at->last[axis != 1].y + 1; ++y) {
      const lanes here = wz * hat_at(by, y), above = here * bx.share, below = here - above;
      const int c = (z + 1) * l.layer + (y + 1) * l.row + x + 1;
      const lanes row = LOAD(whole, c);
      add_faces(&sums, below, picked(row, lower));
      add_faces(&sums, above, picked(row, upper));
      if (gappy == 0) continue;
      const lanes known = LOAD(gappy, c);
      add_known(&sums, below, picked(known, lower));
      add_known(&sums, above, picked(known, upper));
    }
  }
  return sums;
}
#endif

// `gappy`: 0 if there is none. Nothing above the grid.
static FaceSums sum_of_faces(constant MacGrid* g, const Placed* at, int axis,
                             global const float* whole, global const float* gappy) {
  const int first = axis * g->level[0].cells;
  whole += first;
  if (gappy != 0) gappy += first;
#ifdef PICKS
  if (at->last[axis != 0].x - at->first[axis != 0].x < LANES - 1) {
    return sum_by_row(g, at, axis, whole, gappy);
  }
#endif
  return sum_by_place(g, at, axis, whole, gappy);
}
