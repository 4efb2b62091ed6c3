// SPDX-License-Identifier: MIT
// Tank walls as half-spaces without boundary particles: behind a wall lies the mirror image of the
// fluid, in layers one spacing apart, the first as deep as the particle is high. Its part of the
// kernel's weight is known in closed form, 0.187 at half a spacing as in the fluid's own lattice (a
// continuous half-space would weigh 0.215 and push the fluid away). Because the image comes nearer
// as the particle does, the weight falls twice as fast as that of a fixed layer: the particle's own
// pressure alone then balances the fluid's, and the wall's push is the gradient of an energy.
// A film comes nearer than half a spacing, where the mirror's weight falls by up to 3.5 / H: with
// what its particles do to each other it would swing faster than the 3.08 c0 / H that steps are
// made for. So nearer than that, where the lattice begins, the weight falls on as it does there, by
// 2.4 / H: a film of one layer swings at 2.8 to 2.95 c0 / H (sim_fluid_test
// --gtest_filter='FilmLimit*'), and the push is still the gradient of an energy.
// On a slope the water thins out to nothing, where an image at twice the height leaves a particle
// no place to rest (a pool stayed at 0.35 m/s): there, and on the floor that it continues, the
// layers stay where they are.
// Walls that meet at a right angle leave the fluid the product of what each leaves, and push with
// its gradient. (To let each push with all of its image, corners included, brings the pressure at
// rest in the edges of a tank from 21 % too high to 13 %, but is no gradient of an energy.) The
// sloped floor replaces the floor where it is nearer.

#include "sim-server/fluid/lanes/lanes.h"
#include "sim-server/fluid/params/fluid_params.h"
#include "sim-server/fluid/params/parts.h"
#include "sim-server/fluid/params/smoothing.h"

#define KEPT_OFF_WALLS 0.05f  // least distance of a particle from a wall [spacings]

typedef struct {
  lanes share;       // part of the kernel's weight inside walls [1]
  lanes gx, gy, gz;  // its gradient [1/m]: points into the walls
  lanes swept;       // its growth per way of the piston [1/m]
} WallField;

static bool has_slope(constant FluidParams* p) { return HAS_SLOPE && p->slope >= 0; }

static lanes wall_distance(constant FluidParams* p, int k, lanes x, lanes y, lanes z,
                           float piston) {
  const float moved = HAS_PISTON && k == p->piston ? piston : 0.0f;
  return p->walls[k].nx * x + p->walls[k].ny * y + p->walls[k].nz * z -
         (p->walls[k].offset + moved);
}

// Part of the kernel's weight behind a wall at distance d, and its fall with d [1], [1/m].
static lanes behind_wall(constant FluidParams* p, lanes d, bool mirrors, lanes* fall) {
  const lanes outside = fmax(d, 0.0f);
  const lanes kept = fmax(d, 0.5f * p->spacing);
  lanes share = 0.0f;
  *fall = 0.0f;
  for (int layer = 0; layer < WALL_LAYERS; ++layer) {
    const lanes z = mirrors ? 2.0f * kept + layer * p->spacing
                            : outside + (layer + 0.5f) * p->spacing;
    share += p->layer_weight * plane_marginal(z, p->inverse_support);
    *fall += p->layer_weight * (mirrors ? 2.0f : 1.0f) *
             plane_marginal_fall(z, p->inverse_support);
  }
  return mirrors ? share + *fall * (kept - outside) : share;
}

static WallField wall_field(constant FluidParams* p, lanes x, lanes y, lanes z, float piston) {
  WallField field = {0.0f, 0.0f, 0.0f, 0.0f, 0.0f};
  lanes open = 1.0f;
  for (int k = 0; k < p->wall_count; ++k) {
    lanes d = wall_distance(p, k, x, y, z, piston);
    if (has_slope(p) && (k == 0 || k == p->slope)) {
      // Of the floor and the slope the farther one is hidden.
      const lanes other = wall_distance(p, k == 0 ? p->slope : 0, x, y, z, piston);
      const lane_flags hidden = k == 0 ? other < d : other <= d;
      d = select(d, (lanes)(FAR_AWAY), hidden);
    }
    if (!(least(d) < p->support)) continue;
    lanes fall;
    const lanes behind = behind_wall(p, d, !has_slope(p) || (k != 0 && k != p->slope), &fall);
    const lanes left = 1.0f - behind;
    const lanes pull = fall / left;
    field.gx -= pull * p->walls[k].nx;
    field.gy -= pull * p->walls[k].ny;
    field.gz -= pull * p->walls[k].nz;
    if (HAS_PISTON && k == p->piston) field.swept = pull;
    open *= left;
  }
  field.share = 1.0f - open;
  field.gx *= open;
  field.gy *= open;
  field.gz *= open;
  field.swept *= open;
  return field;
}

// Particles stay in front of the walls: one that came closer than KEPT_OFF_WALLS is put back to
// that distance, and its motion into the wall ends.

static void keep_in_tank(constant FluidParams* p, float piston, float piston_speed, lanes* x,
                         lanes* y, lanes* z, lanes* u, lanes* v, lanes* w) {
  const float closest = KEPT_OFF_WALLS * p->spacing;
  for (int k = 0; k < p->wall_count; ++k) {
    const lanes inside = fmax(closest - wall_distance(p, k, *x, *y, *z, piston), 0.0f);
    if (!(least(-inside) < 0.0f)) continue;
    const float nx = p->walls[k].nx, ny = p->walls[k].ny, nz = p->walls[k].nz;
    *x += inside * nx;
    *y += inside * ny;
    *z += inside * nz;
    const lanes speed = nx * *u + ny * *v + nz * *w - (k == p->piston ? piston_speed : 0.0f);
    const lanes stopped = select((lanes)(0.0f), fmin(speed, 0.0f), inside > 0.0f);
    *u -= stopped * nx;
    *v -= stopped * ny;
    *w -= stopped * nz;
  }
}
