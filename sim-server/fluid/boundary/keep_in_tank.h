// SPDX-License-Identifier: MIT
// Nobody is left behind a wall: what came closer is put off it again (walls.h), and its motion into
// the wall ends.

#include "sim-server/fluid/boundary/walls.h"
#include "sim-server/fluid/lanes/lanes.h"
#include "sim-server/fluid/params/fluid_params.h"

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
