// SPDX-License-Identifier: MIT
// What keeps the particles apart evenly: pressures by the state equation, of water in which sound
// is slow, push as in pressure/acceleration.cl. Nothing heavy hangs on them, the grid carries that.
//   a_i = - sum_j m (P_i + P_j) grad W_ij - P_i rho0 grad (share_i + f_i)    [m/s2]
// with walls and bodies as there.

#include "sim-server/fluid/boundary/bodies.h"
#include "sim-server/fluid/boundary/body_image.h"
#include "sim-server/fluid/boundary/walls.h"
#include "sim-server/fluid/lanes/lanes.h"
#include "sim-server/fluid/neighbours/group.h"
#include "sim-server/fluid/neighbours/near.h"
#include "sim-server/fluid/neighbours/pair.h"
#include "sim-server/fluid/params/fluid_params.h"
#include "sim-server/fluid/params/smoothing.h"

static BodyShare share_of_bodies(constant FluidParams* p, const Group* g,
                                 global const int* body_start, global const float* body_position,
                                 global const float* body_volume, int stride) {
  BodyShare share = {0.0f, 0.0f, 0.0f, 0.0f};
  Near near;
  begin_search(&near);
  while (search(p, g, body_start, body_position, stride, &near)) {
    for (int k = 0; k < near.count; ++k) {
      const int j = NEAR(near, k);
      const Pair pair = pair_with(p, g, body_position, stride, j);
      add_share(p, &pair, body_volume[j], &share);
    }
  }
  return share;
}

// `slower`: square of that sound over the scene's. Away from bodies only steps that are to push
// `everywhere` do so, for as many `steps`. `by_bodies`: the part of the acceleration by
// bodies [m/s2], written if any body is felt (`feels` is not 0).
kernel void find_spacing(constant FluidParams* p, float slower, int everywhere, float steps,
                         global const int* cell_start, global const float* position,
                         global const float* term, global const float* images,
                         global const int* body_start, global const float* body_position,
                         global const float* body_volume, int body_stride,
                         global const BodyStep* bodies, int first_body, int body_count,
                         float piston, global float* acceleration, int feels,
                         global float* by_bodies) {
  const int n = p->capacity;
  const int first = get_global_id(0) * LANES;
  const int last = min(first + LANES, p->count);
  if (first >= last) return;
  const lanes own = LOAD(term, first);
  lanes ax = 0.0f, ay = 0.0f, az = 0.0f, bodies_x = 0.0f, bodies_y = 0.0f, bodies_z = 0.0f;
  for (int turn = first; turn < last;) {
    const Group g = load_group(p, cell_start, position, first, last, turn);
    turn = g.next;
    const bool near_any = bodies_near_box(bodies, first_body, body_count, g.lower, g.upper);
    if (!near_any && !everywhere) continue;
    const lanes away = everywhere ? steps * slower : 0.0f;
    const lane_flags beside = lanes_near_bodies(bodies, first_body, body_count, g.x, g.y, g.z);
    const lanes strength = select(away, (lanes)(slower), beside);
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
    lanes bx = 0.0f, by = 0.0f, bz = 0.0f;
    if (near_any) {
      const BodyShare share = share_of_bodies(p, &g, body_start, body_position, body_volume,
                                              body_stride);
      const BodyImage image = load_image(p, images, first);
      image_gradient(p, &image, &share, &bx, &by, &bz);
    }
    const WallField wall = wall_field(p, g.x, g.y, g.z, piston);
    const lanes gradient = strength * gradient_norm(p) * p->mass;
    const lanes by_wall = strength * own * p->rest_density;
    ax = select(ax, gradient * x - by_wall * (wall.gx + bx), g.mine);
    ay = select(ay, gradient * y - by_wall * (wall.gy + by), g.mine);
    az = select(az, gradient * z - by_wall * (wall.gz + bz), g.mine);
    bodies_x = select(bodies_x, -by_wall * bx, g.mine);
    bodies_y = select(bodies_y, -by_wall * by, g.mine);
    bodies_z = select(bodies_z, -by_wall * bz, g.mine);
  }
  STORE(ax, acceleration, first);
  STORE(ay, acceleration + n, first);
  STORE(az, acceleration + 2 * n, first);
  if (!feels) return;
  STORE(bodies_x, by_bodies, first);
  STORE(bodies_y, by_bodies + n, first);
  STORE(bodies_z, by_bodies + 2 * n, first);
}
