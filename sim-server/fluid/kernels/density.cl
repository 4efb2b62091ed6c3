// SPDX-License-Identifier: MIT
// Density by summation over fluid, bodies (as the frozen fluid they displace, Akinci et al. 2012)
// and walls; pressure from the weakly compressible state equation, never negative:
//   rho_i = sum_j m W_ij + sum_b rho0 V_b W_ib + rho0 (share of the kernel inside walls)
//   p_i   = max(0, c0^2 (rho_i - rho0))
// The force needs p / rho^2 only, so that is what is stored.
// The part without bodies is kept, too: it tells water from the film that a body carries along.

// Sum of W / sigma over the neighbours of each target.
static void sum_fluid(constant FluidParams* p, global const int* cell_start,
                      global const float* position, const Targets* at, float* sum) {
  const int n = p->capacity;
  for (int turn = 0; turn < at->turns; ++turn) {
    lanes part[TARGETS];
    for (int t = 0; t < TARGETS; ++t) part[t] = 0.0f;
    for (int k = 0; k < 9; ++k) {
      const int2 run =
          neighbour_run(p, cell_start, at->row[turn], at->from[turn], at->to[turn], k);
      for (int j = run.x; j < run.y; j += LANES) {
        const lanes xj = load_x(position, j, run.y);
        const lanes yj = LOAD(position + n, j);
        const lanes zj = LOAD(position + 2 * n, j);
        for (int t = 0; t < TARGETS; ++t) {
          const lanes dx = at->x[t] - xj;
          const lanes dy = at->y[t] - yj;
          const lanes dz = at->z[t] - zj;
          part[t] += kernel_shape(one_minus_q(dx * dx + dy * dy + dz * dz, p->inverse_support));
        }
      }
    }
    for (int t = 0; t < TARGETS; ++t) {
      if (at->turns == 1 || t == turn) sum[t] = total(part[t]);
    }
  }
}

// Sum of V_b W / sigma over the body points around one place.
static float sum_bodies(constant FluidParams* p, global const int* body_start,
                        global const float* body_position, global const float* body_volume,
                        int stride, float x, float y, float z) {
  const int row = cell_row(p, y, z);
  const int cell = cell_x(p, x);
  lanes sum = 0.0f;
  for (int k = 0; k < 9; ++k) {
    const int2 run = neighbour_run(p, body_start, row, cell, cell, k);
    for (int j = run.x; j < run.y; j += LANES) {
      const lanes dx = x - load_x(body_position, j, run.y);
      const lanes dy = y - LOAD(body_position + stride, j);
      const lanes dz = z - LOAD(body_position + 2 * stride, j);
      sum += LOAD(body_volume, j) *
             kernel_shape(one_minus_q(dx * dx + dy * dy + dz * dz, p->inverse_support));
    }
  }
  return total(sum);
}

kernel void compute_density(constant FluidParams* p, global const int* cell_start,
                            global const float* position, global const int* body_start,
                            global const float* body_position, global const float* body_volume,
                            int body_stride, global const BodyStep* bodies, int first_body,
                            int body_count, float piston, global float* density,
                            global float* water_density, global float* pressure_term) {
  const int first = get_global_id(0) * TARGETS;
  if (first >= p->count) return;
  const Targets at = load_targets(p, position, first);
  float fluid[TARGETS];
  sum_fluid(p, cell_start, position, &at, fluid);

  for (int t = 0; t < TARGETS && first + t < p->count; ++t) {
    const float water =
        p->kernel_norm * p->mass * fluid[t] +
        p->rest_density * wall_field(p, at.x[t], at.y[t], at.z[t], piston).share;
    float rho = water;
    if (near_bodies(bodies, first_body, body_count, at.x[t], at.y[t], at.z[t])) {
      rho += p->kernel_norm * p->rest_density *
             sum_bodies(p, body_start, body_position, body_volume, body_stride, at.x[t], at.y[t],
                        at.z[t]);
    }
    const float pressure = fmax(p->sound_speed * p->sound_speed * (rho - p->rest_density), 0.0f);
    density[first + t] = rho;
    water_density[first + t] = water;
    pressure_term[first + t] = pressure / (rho * rho);
  }
}
