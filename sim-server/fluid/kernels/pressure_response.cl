// SPDX-License-Identifier: MIT
// How a particle's density answers to motion and to its own pressure; the same for all iterations
// of a step. With the gradient of its density by its own place,
//   G_i = sum_j m grad W_ij + rho0 f' sum_b V_b grad W_ib + rho0 (gradient of the walls' share),
// density changes at the rate
//   v_i . G_i - sum_j m v_j . grad W_ij + (part of moving bodies and piston),
// and a pressure p_i / rho_i^2 = P_i, which pushes the particle by -P_i G_i and each neighbour by
// +P_i m grad W_ij (kernels/acceleration.cl), changes that rate by -P_i times the response
//   D_i = |G_i|^2 + sum_j |m grad W_ij|^2            Bender & Koschier 2017, eq. 9

typedef struct {
  lanes x, y, z;  // sum of m grad W or rho0 V grad W, divided by -4 sigma / H
  lanes squares;  // of each neighbour's, likewise
  lanes carried;  // sum over moving neighbours of their speed along it
} Response;

static Response response_of_fluid(constant FluidParams* p, const Group* g,
                                  global const int* cell_start, global const float* position) {
  Response sum = {0.0f, 0.0f, 0.0f, 0.0f, 0.0f};
  Near near;
  begin_search(&near);
  while (search(p, g, cell_start, position, p->capacity, &near)) {
    for (int k = 0; k < near.count; ++k) {
      const Pair pair = pair_with(p, g, position, p->capacity, NEAR(near, k));
      sum.x += pair.slope * pair.dx;
      sum.y += pair.slope * pair.dy;
      sum.z += pair.slope * pair.dz;
      sum.squares += pair.slope * pair.slope * pair.r2;
    }
  }
  sum.x *= p->mass;
  sum.y *= p->mass;
  sum.z *= p->mass;
  sum.squares *= p->mass * p->mass;
  return sum;
}

static void add_response_of_bodies(constant FluidParams* p, const Group* g,
                                   global const int* body_start,
                                   global const float* body_position,
                                   global const float* body_velocity,
                                   global const float* body_volume, int stride, lanes rise,
                                   Response* sum) {
  Near near;
  begin_search(&near);
  while (search(p, g, body_start, body_position, stride, &near)) {
    for (int k = 0; k < near.count; ++k) {
      const int j = NEAR(near, k);
      const Pair pair = pair_with(p, g, body_position, stride, j);
      const lanes slope = p->rest_density * body_volume[j] * rise * pair.slope;
      sum->x += slope * pair.dx;
      sum->y += slope * pair.dy;
      sum->z += slope * pair.dz;
      sum->carried += slope * (pair.dx * body_velocity[j] + pair.dy * body_velocity[stride + j] +
                               pair.dz * body_velocity[2 * stride + j]);
    }
  }
}

kernel void measure_response(constant FluidParams* p, global const int* cell_start,
                             global const int* awake, global const float* position,
                             global const float* density, global const float* water_density,
                             global const int* body_start,
                             global const float* body_position,
                             global const float* body_velocity, global const float* body_volume,
                             int body_stride, global const BodyStep* bodies, int first_body,
                             int body_count, float piston, float piston_speed,
                             global float* gradient, global float* response,
                             global float* boundary_rate) {
  const int n = p->capacity;
  const int first = group_of(p, get_global_id(0)) * LANES;
  const int last = min(first + LANES, p->count);
  const float scale = -gradient_norm(p);
  lanes gx = 0.0f, gy = 0.0f, gz = 0.0f, d = 0.0f, rate = 0.0f;
  for (int turn = first; turn < last;) {
    const Group g = load_group(p, cell_start, position, first, last, turn);
    if (!awake_near(p, awake, &g, WAKES_MOTION)) {
      turn = g.next;
      continue;
    }
    Response sum = response_of_fluid(p, &g, cell_start, position);
    if (bodies_near_box(bodies, first_body, body_count, g.lower, g.upper)) {
      const lanes image = (LOAD(density, first) - LOAD(water_density, first)) / p->rest_density;
      add_response_of_bodies(p, &g, body_start, body_position, body_velocity, body_volume,
                             body_stride, image_rise(p, image), &sum);
    }
    const WallField wall = wall_field(p, g.x, g.y, g.z, piston);
    const lanes x = scale * sum.x + p->rest_density * wall.gx;
    const lanes y = scale * sum.y + p->rest_density * wall.gy;
    const lanes z = scale * sum.z + p->rest_density * wall.gz;
    gx = select(gx, x, g.mine);
    gy = select(gy, y, g.mine);
    gz = select(gz, z, g.mine);
    d = select(d, x * x + y * y + z * z + scale * scale * sum.squares, g.mine);
    rate = select(rate, p->rest_density * piston_speed * wall.swept - scale * sum.carried, g.mine);
    turn = g.next;
  }
  if (first >= last) return;
  STORE(gx, gradient, first);
  STORE(gy, gradient + n, first);
  STORE(gz, gradient + 2 * n, first);
  STORE(d, response, first);
  STORE(rate, boundary_rate, first);
}
