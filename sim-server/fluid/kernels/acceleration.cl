// SPDX-License-Identifier: MIT
// Acceleration by pressure, viscosity and gravity:
//   a_i = - sum_j m (P_i + P_j) grad W_ij              P = p / rho^2, Monaghan 2005 eq. 3.1
//         + sum_j m K_ij / rho0 (v_ij . x_ij) / (r^2 + eta^2) grad W_ij
//         + g
// with K = 10 nu, and alpha c0 h more for pairs that approach (Monaghan 2005 sections 4 and 5).
// Bodies and walls push with the particle's own pressure alone, -P_i grad rho_i: what the energy of
// the particle's compression gives (Akinci et al. 2012 eq. 9). Mirroring the pressure as well
// (2 P_i) keeps a little more distance, but is not the gradient of any energy: a pool at rest then
// simmers at 33 mm/s where this form calms to 4. Walls do not rub.

// What the pair forces need of the particle they act on.
typedef struct {
  float x, y, z;  // [m]
  float u, v, w;  // [m/s]
  float own;      // p / rho^2
} Mover;

// What each neighbour does to a mover, divided by -grad W's factor and the neighbour's mass:
// to be weighed and summed. `theirs`: p / rho^2 of the neighbours.
typedef struct {
  lanes x, y, z;
} Push;

static Push push(constant FluidParams* p, const Mover* m, lanes xj, lanes yj, lanes zj, lanes uj,
                 lanes vj, lanes wj, lanes theirs) {
  const float eta2 = 0.01f * 0.25f * p->support * p->support;  // (0.1 h)^2, h = H / 2
  const float viscous = p->viscous / p->rest_density;
  const float artificial = p->artificial / p->rest_density;
  const lanes dx = m->x - xj;
  const lanes dy = m->y - yj;
  const lanes dz = m->z - zj;
  const lanes r2 = dx * dx + dy * dy + dz * dz;
  const lanes q1 = one_minus_q(r2, p->inverse_support);
  const lanes closing = (m->u - uj) * dx + (m->v - vj) * dy + (m->w - wj) * dz;
  const lanes rub = (viscous * closing + artificial * fmin(closing, 0.0f)) * inverse(r2 + eta2);
  const lanes f = q1 * q1 * q1 * (m->own + theirs - rub);
  const Push result = {f * dx, f * dy, f * dz};
  return result;
}

static void push_by_fluid(constant FluidParams* p, global const int* cell_start,
                          global const float* position, global const float* velocity,
                          global const float* pressure_term, const Targets* at,
                          const Mover* movers, float3* sum) {
  const int n = p->capacity;
  for (int turn = 0; turn < at->turns; ++turn) {
    lanes ax[TARGETS], ay[TARGETS], az[TARGETS];
    for (int t = 0; t < TARGETS; ++t) ax[t] = ay[t] = az[t] = 0.0f;
    for (int k = 0; k < 9; ++k) {
      const int2 run =
          neighbour_run(p, cell_start, at->row[turn], at->from[turn], at->to[turn], k);
      for (int j = run.x; j < run.y; j += LANES) {
        const lanes xj = load_x(position, j, run.y);
        const lanes yj = LOAD(position + n, j);
        const lanes zj = LOAD(position + 2 * n, j);
        const lanes uj = LOAD(velocity, j);
        const lanes vj = LOAD(velocity + n, j);
        const lanes wj = LOAD(velocity + 2 * n, j);
        const lanes pj = LOAD(pressure_term, j);
        for (int t = 0; t < TARGETS; ++t) {
          const Push f = push(p, &movers[t], xj, yj, zj, uj, vj, wj, pj);
          ax[t] += f.x;
          ay[t] += f.y;
          az[t] += f.z;
        }
      }
    }
    for (int t = 0; t < TARGETS; ++t) {
      if (at->turns == 1 || t == turn) sum[t] = (float3)(total(ax[t]), total(ay[t]), total(az[t]));
    }
  }
}

static float3 push_by_bodies(constant FluidParams* p, global const int* body_start,
                             global const float* body_position, global const float* body_velocity,
                             global const float* body_volume, int stride, const Mover* mover) {
  const int row = cell_row(p, mover->y, mover->z);
  const int cell = cell_x(p, mover->x);
  lanes bx = 0.0f, by = 0.0f, bz = 0.0f;
  for (int k = 0; k < 9; ++k) {
    const int2 run = neighbour_run(p, body_start, row, cell, cell, k);
    for (int j = run.x; j < run.y; j += LANES) {
      const Push f = push(p, mover, load_x(body_position, j, run.y),
                          LOAD(body_position + stride, j),
                          LOAD(body_position + 2 * stride, j), LOAD(body_velocity, j),
                          LOAD(body_velocity + stride, j), LOAD(body_velocity + 2 * stride, j),
                          (lanes)(0.0f));
      const lanes volume = LOAD(body_volume, j);
      bx += volume * f.x;
      by += volume * f.y;
      bz += volume * f.z;
    }
  }
  return (float3)(total(bx), total(by), total(bz));
}

kernel void compute_acceleration(constant FluidParams* p, global const int* cell_start,
                                 global const float* position, global const float* velocity,
                                 global const float* pressure_term,
                                 global const int* body_start, global const float* body_position,
                                 global const float* body_velocity,
                                 global const float* body_volume, int body_stride,
                                 global const BodyStep* bodies, int first_body, int body_count,
                                 float piston, global float* acceleration) {
  const int first = get_global_id(0) * TARGETS;
  if (first >= p->count) return;
  const int n = p->capacity;
  const Targets at = load_targets(p, position, first);
  Mover movers[TARGETS];
  for (int t = 0; t < TARGETS; ++t) {
    const int i = min(first + t, p->count - 1);
    const Mover m = {at.x[t], at.y[t], at.z[t], velocity[i], velocity[n + i], velocity[2 * n + i],
                     pressure_term[i]};
    movers[t] = m;
  }
  float3 fluid[TARGETS];
  push_by_fluid(p, cell_start, position, velocity, pressure_term, &at, movers, fluid);

  // grad W = -20 sigma / H^2 (1 - q)^3 x
  const float gradient = 20.0f * p->kernel_norm * p->inverse_support * p->inverse_support;
  for (int t = 0; t < TARGETS && first + t < p->count; ++t) {
    float3 a = gradient * p->mass * fluid[t];
    if (near_bodies(bodies, first_body, body_count, at.x[t], at.y[t], at.z[t])) {
      a += gradient * p->rest_density *
           push_by_bodies(p, body_start, body_position, body_velocity, body_volume, body_stride,
                          &movers[t]);
    }
    const WallField wall = wall_field(p, at.x[t], at.y[t], at.z[t], piston);
    a -= movers[t].own * p->rest_density * (float3)(wall.gx, wall.gy, wall.gz);
    a += (float3)(p->gravity_x, p->gravity_y, p->gravity_z);
    acceleration[first + t] = a.x;
    acceleration[n + first + t] = a.y;
    acceleration[2 * n + first + t] = a.z;
  }
}
