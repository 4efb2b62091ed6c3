// SPDX-License-Identifier: MIT
// What each point of a body's skin sees of the water (paper, section 5.1.2):
//   c_f = sum_j V_j W,   its gradient,   and the water's velocity  sum_j V_j W v_j / c_f
// over particles that belong to a body of water. Spray and the film that a body carries along are
// no surface that could be hit. Particles of them are those around which the mean density of the
// neighbours is low, without the bodies' part of it. A particle's own density would not do: next to
// a solid it has few neighbours, although the water goes on.
// And how much matter backs what it may hit: the colour of all water and of the tank's solid at a
// place as far ahead along its normal as the water is deep that a blow of the whole body moves.

#include "sim-server/detect/touch.h"
#include "sim-server/fluid/boundary/bodies.h"
#include "sim-server/fluid/boundary/walls.h"
#include "sim-server/fluid/lanes/lanes.h"
#include "sim-server/fluid/neighbours/around.h"
#include "sim-server/fluid/params/fluid_params.h"
#include "sim-server/fluid/params/smoothing.h"

// Matter at a place: colour of all water, and 1 inside walls.
static float matter_at(constant FluidParams* p, const Cloud* water, float piston, float x, float y,
                       float z) {
  for (int k = 0; k < p->wall_count; ++k) {
    if (first_lane(wall_distance(p, k, (lanes)(x), (lanes)(y), (lanes)(z), piston)) <= 0.0f) {
      return 1.0f;
    }
  }
  lanes c = 0.0f;
  for (Around a = around(p, x, y, z); next_around(p, water, &a);) {
    c += kernel_shape(square_of(&a), p->inverse_support);
  }
  const float share = p->mass / p->rest_density * p->kernel_norm * total(c);
  const float walls =
      first_lane(wall_field(p, (lanes)(x), (lanes)(y), (lanes)(z), piston).share);
  return fmin(share + walls, 1.0f);
}

// sum_j W rho_j / sum_j W of each particle near a body; of others `mean` stays as it is.
kernel void average_density(constant FluidParams* p, global const int* cell_start,
                            global const float* position, global const float* density, int count,
                            global const BodyStep* bodies, int first_body, int body_count,
                            global float* mean) {
  const int i = get_global_id(0);
  if (i >= count) return;
  const int n = p->capacity;
  const float x = position[i], y = position[n + i], z = position[2 * n + i];
  if (!near_bodies(bodies, first_body, body_count, x, y, z)) return;
  const Cloud water = {cell_start, position, n};
  lanes sum = 0.0f, weights = 0.0f;
  for (Around a = around(p, x, y, z); next_around(p, &water, &a);) {
    const lanes weight = kernel_shape(square_of(&a), p->inverse_support);
    sum += weight * LOAD(density, a.j);
    weights += weight;
  }
  mean[i] = total(sum) / fmax(total(weights), TINY);
}

// `skin`: points of the bodies' true surfaces in body axes; `facing`: of each its normal and how
// far ahead it looks [m]; `owner`: which body each belongs to; `density`: averaged.
kernel void touch_water(constant FluidParams* p, global const int* cell_start,
                        global const float* position, global const float* velocity,
                        global const float* density, int points, global const float* skin,
                        global const float* facing, global const int* owner,
                        global const BodyStep* bodies, int first_body, float piston,
                        global Touch* out) {
  const int s = get_global_id(0);
  if (s >= points) return;
  const int n = p->capacity;
  const BodyStep b = bodies[first_body + owner[s]];
  const float3 arm = rotate_by((float3)(skin[3 * s], skin[3 * s + 1], skin[3 * s + 2]), b.qx, b.qy,
                               b.qz, b.qw);
  const float3 normal = rotate_by((float3)(facing[4 * s], facing[4 * s + 1], facing[4 * s + 2]),
                                  b.qx, b.qy, b.qz, b.qw);
  const float3 motion = (float3)(b.vx, b.vy, b.vz) + cross((float3)(b.wx, b.wy, b.wz), arm);
  const float x = b.px + arm.x, y = b.py + arm.y, z = b.pz + arm.z;
  const Cloud water = {cell_start, position, n};
  const float least = p->least_density;
  lanes all = 0.0f, c = 0.0f, gx = 0.0f, gy = 0.0f, gz = 0.0f, u = 0.0f, v = 0.0f, w = 0.0f;
  for (Around a = around(p, x, y, z); next_around(p, &water, &a);) {
    const lanes dense = step((lanes)(least), LOAD(density, a.j));
    const lanes r2 = square_of(&a);
    const lanes shape = kernel_shape(r2, p->inverse_support);
    const lanes weight = dense * shape;
    const lanes slope = dense * kernel_slope(r2, p->inverse_support);
    all += shape;
    c += weight;
    gx -= slope * a.dx;
    gy -= slope * a.dy;
    gz -= slope * a.dz;
    u += weight * LOAD(velocity, a.j);
    v += weight * LOAD(velocity + n, a.j);
    w += weight * LOAD(velocity + 2 * n, a.j);
  }
  const float volume = p->mass / p->rest_density;
  const float gradient = gradient_norm(p) * volume;
  const float sum = total(c);
  const float share = 1.0f / fmax(sum, TINY);
  const float far = facing[4 * s + 3];
  const float ahead = matter_at(p, &water, piston, x + far * normal.x, y + far * normal.y,
                                z + far * normal.z);
  const float colour = volume * p->kernel_norm;
  const Touch touch = {colour * sum, gradient * total(gx), gradient * total(gy),
                       gradient * total(gz), x, y, z, motion.x, motion.y, motion.z,
                       share * total(u), share * total(v), share * total(w), normal.x, normal.y,
                       normal.z, ahead, colour * total(all)};
  out[s] = touch;
}
