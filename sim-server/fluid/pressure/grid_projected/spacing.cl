// SPDX-License-Identifier: MIT
// What keeps the particles apart evenly: pressures by the state equation, of water in which sound
// is slow, push as in pressure/acceleration.cl. Nothing heavy hangs on them, the grid carries that.
//   a_i = - sum_j m (P_i + P_j) grad W_ij - P_i rho0 grad share_i            [m/s2]

#include "sim-server/fluid/boundary/walls.h"
#include "sim-server/fluid/lanes/lanes.h"
#include "sim-server/fluid/neighbours/group.h"
#include "sim-server/fluid/neighbours/near.h"
#include "sim-server/fluid/neighbours/pair.h"
#include "sim-server/fluid/params/fluid_params.h"
#include "sim-server/fluid/params/smoothing.h"

// `slower`: square of that sound over the scene's. All particles move.
kernel void find_spacing(constant FluidParams* p, float slower, global const int* cell_start,
                         global const float* position, global const float* term, float piston,
                         global float* acceleration, global int* moving) {
  const int n = p->capacity;
  const int first = get_global_id(0) * LANES;
  const int last = min(first + LANES, p->count);
  if (first >= last) return;
  const float gradient = slower * gradient_norm(p) * p->mass;
  const lanes own = LOAD(term, first);
  lanes ax = 0.0f, ay = 0.0f, az = 0.0f;
  for (int turn = first; turn < last;) {
    const Group g = load_group(p, cell_start, position, first, last, turn);
    lanes x = 0.0f, y = 0.0f, z = 0.0f;
    Near near;
    begin_search(&near);
    while (search(p, &g, cell_start, position, n, &near)) {
      for (int k = 0; k < near.count; ++k) {
        const int j = NEAR(near, k);
        const Pair pair = pair_with(p, &g, position, n, j);
        const lanes f = pair.slope * (own + term[j]);
        x += f * pair.dx;
        y += f * pair.dy;
        z += f * pair.dz;
      }
    }
    const WallField wall = wall_field(p, g.x, g.y, g.z, piston);
    const lanes by_wall = slower * own * p->rest_density;
    ax = select(ax, gradient * x - by_wall * wall.gx, g.mine);
    ay = select(ay, gradient * y - by_wall * wall.gy, g.mine);
    az = select(az, gradient * z - by_wall * wall.gz, g.mine);
    turn = g.next;
  }
  const lane_flags all = -1;
  STORE(all, moving, first);
  STORE(ax, acceleration, first);
  STORE(ay, acceleration + n, first);
  STORE(az, acceleration + 2 * n, first);
}
