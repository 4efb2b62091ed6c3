// SPDX-License-Identifier: MIT
// Air that water folds in where it loses its energy at the surface. Around each particle, within
// `reach` whatever the spacing and weighed by 1 - r^2 / reach^2,
//   k = (<|v|^2> - |<v>|^2) / 2     energy of the motion that is narrower than that [m2/s2],
//   a = 1 - water - bodies - walls  share of air.
// Eddies hand k on within reach / sqrt(k) (Kolmogorov 1941). What exceeds `least` lifts air:
//   rate = factor 4 a (1 - a) (k - least)^(3/2).
// Twice the product of both shares is the chance that of two places near by one holds air and the
// other does not: a half at a flat surface, none deep in water, little around drops in the air. A
// sum over the particles is an integral over the water that does not ask how many they are, so one
// in SPLASH_FOLDS_APART of those in grid order stands for its neighbours; `phase`: which.
// k is at most half the square of the highest speed within reach: where that cannot exceed `least`,
// the sums are left out.

#include "sim-server/detect/bubble_state.h"
#include "sim-server/fluid/boundary/walls.h"
#include "sim-server/fluid/lanes/lanes.h"
#include "sim-server/fluid/neighbours/grid.h"
#include "sim-server/fluid/params/fluid_params.h"

// Bulk water's share differs from 1 by about as much; less air is none [1].
#define LEAST_AIR 0.03f

// The runs of cells within `reach` of a place, one for each row.
typedef struct {
  float x, y, z;
  int from_x, to_x, from_y, to_y, to_z;
  int row_y, row_z;
} Reach;

static Reach within(constant FluidParams* p, float x, float y, float z, float reach) {
  Reach r;
  r.x = x;
  r.y = y;
  r.z = z;
  r.from_x = slice_x(p, x - reach);
  r.to_x = slice_x(p, x + reach);
  r.from_y = cell_along(y - reach, p->origin_y, p->inverse_cell, p->cells_y);
  r.to_y = cell_along(y + reach, p->origin_y, p->inverse_cell, p->cells_y);
  r.row_z = cell_along(z - reach, p->origin_z, p->inverse_cell, p->cells_z);
  r.to_z = cell_along(z + reach, p->origin_z, p->inverse_cell, p->cells_z);
  r.row_y = r.from_y;
  return r;
}

// False: there are no more. Gives the first point of the next run, and the one past its last.
static bool next_run(constant FluidParams* p, global const int* start, Reach* r, int2* run) {
  if (r->row_z > r->to_z) return false;
  const int base = (r->row_z * p->cells_y + r->row_y) * p->cells_x * SLICES;
  *run = (int2)(start[base + r->from_x], start[base + r->to_x + 1]);
  if (++r->row_y > r->to_y) {
    r->row_y = r->from_y;
    ++r->row_z;
  }
  return true;
}

// Finds for each cell the square of the highest speed of its particles [m2/s2]; 0 in empty cells.
// Each work-item handles one row of cells.
kernel void find_fastest(constant FluidParams* p, global const int* cell_start,
                         global const float* velocity, global float* fastest) {
  const int row = get_global_id(0);
  if (row >= p->cells_y * p->cells_z) return;
  const int n = p->capacity;
  for (int cell = row * p->cells_x; cell < (row + 1) * p->cells_x; ++cell) {
    const int first = cell_start[cell * SLICES], last = cell_start[(cell + 1) * SLICES];
    lanes squares = 0.0f;
    for (int j = first; j < last; j += LANES) {
      const lane_flags here = LANE_NUMBERS < (lane_flags)(last - j);
      squares = fmax(squares, select((lanes)(0.0f), squares_at(velocity, n, j), here));
    }
    fastest[cell] = most(squares);
  }
}

// Whether any particle in the cells within reach has a speed whose square exceeds `square` [m2/s2].
static bool any_faster(constant FluidParams* p, const Reach* r, global const float* fastest,
                       float square) {
  const int first = r->from_x / SLICES, last = r->to_x / SLICES;
  for (int z = r->row_z; z <= r->to_z; ++z) {
    for (int y = r->from_y; y <= r->to_y; ++y) {
      global const float* row = fastest + (z * p->cells_y + y) * p->cells_x;
      for (int x = first; x <= last; ++x) {
        if (row[x] > square) return true;
      }
    }
  }
  return false;
}

// Weights of LANES points from `j` on.
static lanes weights(global const float* position, int stride, const Reach* r, int j, int end,
                     float inverse_reach) {
  const lanes dx = r->x - load_x(position, j, end);
  const lanes dy = r->y - LOAD(position + stride, j);
  const lanes dz = r->z - LOAD(position + 2 * stride, j);
  return fmax(1.0f - (dx * dx + dy * dy + dz * dz) * (inverse_reach * inverse_reach), 0.0f);
}

// Share of the weight that lies behind the walls: of a plane at q = d / reach the integral of
// 15/16 (1 - s^2)^2 from q to 1. Walls that meet leave the product of what each leaves.
static float behind_walls(constant FluidParams* p, float x, float y, float z, float piston,
                          float inverse_reach) {
  float open = 1.0f;
  for (int k = 0; k < p->wall_count; ++k) {
    const float d = first_lane(wall_distance(p, k, (lanes)(x), (lanes)(y), (lanes)(z), piston));
    if (has_slope(p) && (k == 0 || k == p->slope)) {
      const float other = first_lane(
          wall_distance(p, k == 0 ? p->slope : 0, (lanes)(x), (lanes)(y), (lanes)(z), piston));
      if (k == 0 ? other < d : other <= d) continue;  // of floor and slope the nearer one counts
    }
    const float q = clamp(d * inverse_reach, 0.0f, 1.0f);
    const float q2 = q * q;
    open *= 0.5f + 0.9375f * q * (1.0f + q2 * (-2.0f / 3.0f + 0.2f * q2));
  }
  return 1.0f - open;
}

// Share of the weight that the bodies' points hold.
static float inside_bodies(constant FluidParams* p, global const int* start,
                           global const float* position, global const float* volume, int stride,
                           float x, float y, float z, float inverse_reach, float norm) {
  lanes sum = 0.0f;
  int2 run;
  for (Reach r = within(p, x, y, z, 1.0f / inverse_reach); next_run(p, start, &r, &run);) {
    for (int j = run.x; j < run.y; j += LANES) {
      sum += LOAD(volume, j) * weights(position, stride, &r, j, run.y, inverse_reach);
    }
  }
  return norm * total(sum);
}

kernel void fold_air(constant FluidParams* p, global const int* cell_start,
                     global const float* position, global const float* velocity,
                     global const int* id, global const int* body_start,
                     global const float* body_position, global const float* body_volume,
                     int body_stride, int body_count, global const float* fastest, float piston,
                     float reach, float least, float factor, int phase, int room,
                     global AirFold* out) {
  const int i = get_global_id(0) * SPLASH_FOLDS_APART + phase;
  if (i >= p->count) return;
  const int n = p->capacity;
  const float x = position[i], y = position[n + i], z = position[2 * n + i];
  const float inverse_reach = 1.0f / reach;
  Reach r = within(p, x, y, z, reach);
  if (!any_faster(p, &r, fastest, 2.0f * least)) return;
  lanes c = 0.0f, cu = 0.0f, cv = 0.0f, cw = 0.0f, squares = 0.0f;
  for (int2 run; next_run(p, cell_start, &r, &run);) {
    for (int j = run.x; j < run.y; j += LANES) {
      const lanes weight = weights(position, n, &r, j, run.y, inverse_reach);
      // Against the particle's own velocity: of fast water the squares alone would differ little.
      const lanes u = LOAD(velocity, j) - velocity[i];
      const lanes v = LOAD(velocity + n, j) - velocity[n + i];
      const lanes w = LOAD(velocity + 2 * n, j) - velocity[2 * n + i];
      c += weight;
      cu += weight * u;
      cv += weight * v;
      cw += weight * w;
      squares += weight * (u * u + v * v + w * w);
    }
  }
  const float sum = total(c);  // its own weight is 1
  const float mu = total(cu) / sum, mv = total(cv) / sum, mw = total(cw) / sum;
  const float excess = 0.5f * (total(squares) / sum - (mu * mu + mv * mv + mw * mw)) - least;
  if (!(excess > 0.0f)) return;
  const float norm = 15.0f / (8.0f * M_PI_F) * inverse_reach * inverse_reach * inverse_reach;
  float air = 1.0f - norm * p->mass / p->rest_density * sum;
  if (!(air > LEAST_AIR)) return;
  air -= behind_walls(p, x, y, z, piston, inverse_reach);
  if (air > LEAST_AIR && body_count > 0) {
    air -= inside_bodies(p, body_start, body_position, body_volume, body_stride, x, y, z,
                         inverse_reach, norm);
  }
  if (!(air > LEAST_AIR)) return;
  const int place = atomic_inc(&out->id);  // of the first entry: how many follow
  if (place >= room) return;
  const AirFold fold = {id[i], x, y, z, factor * 4.0f * air * (1.0f - air) * excess * sqrt(excess)};
  out[1 + place] = fold;
}
