// SPDX-License-Identifier: MIT
// What each point of a body's skin sees of the water (paper, section 5.1.2):
//   c_f = sum_j V_j W,   its gradient,   and the water's velocity  sum_j V_j W v_j / c_f
// over particles that belong to a body of water. Spray and the film that a body carries along are
// no surface that could be hit: their density, without the body's part of it, is lower.

typedef struct {
  float colour;                // c_f [1]
  float gx, gy, gz;            // its gradient: points into the water [1/m]
  float x, y, z;               // of the point [m]
  float u, v, w;               // its velocity [m/s]
  float water_u, water_v, water_w;  // the water's mean velocity [m/s]
  float unused[3];
} Touch;

// `skin`: points of the bodies' true surfaces in body axes; `owner`: which body each belongs to.
kernel void touch_water(constant FluidParams* p, global const int* cell_start,
                        global const float* position, global const float* velocity,
                        global const float* density, int points, global const float* skin,
                        global const int* owner, global const BodyStep* bodies, int first_body,
                        global Touch* out) {
  const int s = get_global_id(0);
  if (s >= points) return;
  const int n = p->capacity;
  const BodyStep b = bodies[first_body + owner[s]];
  const float3 arm = rotate_by((float3)(skin[3 * s], skin[3 * s + 1], skin[3 * s + 2]), b.qx, b.qy,
                               b.qz, b.qw);
  const float3 motion = (float3)(b.vx, b.vy, b.vz) + cross((float3)(b.wx, b.wy, b.wz), arm);
  const float x = b.px + arm.x, y = b.py + arm.y, z = b.pz + arm.z;
  const int row = cell_row(p, y, z);
  const int slice = slice_x(p, x);
  const float least = p->least_density;
  lanes c = 0.0f, gx = 0.0f, gy = 0.0f, gz = 0.0f, u = 0.0f, v = 0.0f, w = 0.0f;
  for (int k = 0; k < 9; ++k) {
    const int2 run = neighbour_run(p, cell_start, row, slice, slice, k);
    for (int j = run.x; j < run.y; j += LANES) {
      const lanes dx = x - load_x(position, j, run.y);
      const lanes dy = y - LOAD(position + n, j);
      const lanes dz = z - LOAD(position + 2 * n, j);
      const lanes dense = step((lanes)(least), LOAD(density, j));
      const lanes r2 = dx * dx + dy * dy + dz * dz;
      const lanes weight = dense * kernel_shape(r2, p->inverse_support);
      const lanes slope = dense * kernel_slope(r2, p->inverse_support);
      c += weight;
      gx -= slope * dx;
      gy -= slope * dy;
      gz -= slope * dz;
      u += weight * LOAD(velocity, j);
      v += weight * LOAD(velocity + n, j);
      w += weight * LOAD(velocity + 2 * n, j);
    }
  }
  const float volume = p->mass / p->rest_density;
  const float gradient = gradient_norm(p) * volume;
  const float sum = total(c);
  const float share = 1.0f / fmax(sum, TINY);
  const Touch touch = {volume * p->kernel_norm * sum, gradient * total(gx), gradient * total(gy),
                       gradient * total(gz), x, y, z, motion.x, motion.y, motion.z,
                       share * total(u), share * total(v), share * total(w),
                       {0.0f, 0.0f, 0.0f}};
  out[s] = touch;
}
