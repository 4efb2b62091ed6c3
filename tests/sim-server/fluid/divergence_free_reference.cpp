// SPDX-License-Identifier: MIT
#include "tests/sim-server/fluid/divergence_free_reference.hpp"

#include <algorithm>
#include <cmath>

#include "sim-server/fluid/params/smoothing.hpp"
#include "sim-server/fluid/set_up.hpp"
#include "sim-server/scene/rotation.hpp"
#include "tests/sim-server/fluid/body_image_reference.hpp"

namespace splash::sim {
namespace {

constexpr double kRelaxation = 0.3;

/// m grad W_ij for every j around i.
struct Neighbour {
  std::size_t j;
  Vector3 gradient;
};
using Neighbours = std::vector<std::vector<Neighbour>>;

Neighbours find_neighbours(const FluidState& s) {
  const double support = static_cast<double>(s.params.support);
  const double mass = static_cast<double>(s.params.mass);
  Neighbours all(s.position.size());
  for (std::size_t i = 0; i < all.size(); ++i) {
    for (std::size_t j = 0; j < all.size(); ++j) {
      const Vector3 x = s.position[i] - s.position[j];
      if (dot(x, x) >= support * support) continue;
      all[i].push_back({j, mass * kernel_gradient(length(x), support) * x});
    }
  }
  return all;
}

/// Rate of density that velocities cause [kg/m3 s].
double density_rate(const ReferenceResponse& r, const std::vector<Neighbour>& around,
                    const std::vector<Vector3>& velocity, std::size_t i) {
  double rate = dot(velocity[i], r.gradient[i]) + r.boundary_rate[i];
  for (const Neighbour& n : around) rate -= dot(velocity[n.j], n.gradient);
  return rate;
}

void push(const ReferenceResponse& r, const Neighbours& neighbours,
          const std::vector<double>& change, double dt, std::vector<Vector3>& velocity) {
  for (std::size_t i = 0; i < velocity.size(); ++i) {
    Vector3 a = change[i] * r.gradient[i];
    for (const Neighbour& n : neighbours[i]) a = a + change[n.j] * n.gradient;
    velocity[i] = velocity[i] - dt * a;
  }
}

/// Of the matter of a body at a place; nothing without bodies [m/s].
Vector3 body_velocity_at(const FluidState& s, std::size_t body, const Vector3& place) {
  if (s.bodies.empty()) return {0.0, 0.0, 0.0};
  const BodyStep& b = s.bodies[body];
  const Vector3 centre = {static_cast<double>(b.px), static_cast<double>(b.py),
                          static_cast<double>(b.pz)};
  const Vector3 velocity = {static_cast<double>(b.vx), static_cast<double>(b.vy),
                            static_cast<double>(b.vz)};
  const Vector3 spin = {static_cast<double>(b.wx), static_cast<double>(b.wy),
                        static_cast<double>(b.wz)};
  return velocity + cross(spin, place - centre);
}

}  // namespace

ReferenceResponse reference_response(const FluidState& s, double piston_speed) {
  const double support = static_cast<double>(s.params.support);
  const double rest = static_cast<double>(s.params.rest_density);
  const Neighbours neighbours = find_neighbours(s);
  const std::size_t count = s.position.size();
  ReferenceResponse r = {std::vector<Vector3>(count), std::vector<double>(count),
                         std::vector<double>(count)};
  for (std::size_t i = 0; i < count; ++i) {
    const ReferenceWalls walls = reference_walls(s.params, s.position[i], s.piston);
    Vector3 g = rest * walls.gradient;
    for (const Neighbour& n : neighbours[i]) {
      g = g + n.gradient;
      r.response[i] += dot(n.gradient, n.gradient);
    }
    const ReferenceImage image = reference_image(s, s.position[i]);
    const Vector3 skin = body_velocity_at(s, image.owner, s.position[i]);
    for (std::size_t b = 0; b < s.body_position.size(); ++b) {
      const Vector3 x = s.position[i] - s.body_position[b];
      const double volume = rest * s.body_volume[b];
      const Vector3 along = volume * image.factor * kernel_gradient(length(x), support) * x;
      const Vector3 nearing = volume * kernel_value(length(x), support) * image.gradient;
      g = g + along + nearing;
      r.boundary_rate[i] -= dot(s.body_velocity[b], along) + dot(skin, nearing);
    }
    r.boundary_rate[i] += rest * piston_speed * walls.swept;
    r.gradient[i] = g;
    r.response[i] += dot(g, g);
  }
  return r;
}

ReferenceSolve reference_solve(const FluidState& s, const ReferenceResponse& r,
                               const std::vector<double>& offset, double dt, int iterations,
                               ReferenceSolve from) {
  const Neighbours neighbours = find_neighbours(s);
  const std::size_t count = s.position.size();
  const double support = static_cast<double>(s.params.support);
  const double strongest =
      2.0 * kernel_norm(support) / support * static_cast<double>(s.params.mass);
  const double least = 1.0e-4 * strongest * strongest;
  ReferenceSolve solve = std::move(from);
  const double speed = static_cast<double>(s.params.spacing) / dt;
  const double most = static_cast<double>(s.params.advective_cfl) * speed * speed /
                      static_cast<double>(s.params.rest_density);
  std::vector<double> jacobi = solve.pressure;
  std::vector<double> change(count);
  double t = 1.0;
  for (int k = 0; k <= iterations; ++k) {
    const double next = 0.5 * (1.0 + std::sqrt(1.0 + 4.0 * t * t));
    const double beta = (t - 1.0) / next;
    t = next;
    solve.error_before = solve.error;
    solve.error = 0.0;
    for (std::size_t i = 0; i < count; ++i) {
      const double error = offset[i] + dt * density_rate(r, neighbours[i], solve.velocity, i);
      const double per_error = kRelaxation / (dt * dt * std::max(r.response[i], least));
      const double better = std::clamp(solve.pressure[i] + per_error * error, 0.0, most);
      solve.error += std::abs(better - solve.pressure[i]) / per_error;
      const double with_momentum = better + beta * (better - jacobi[i]);
      change[i] = std::clamp(with_momentum, 0.0, most) - solve.pressure[i];
      jacobi[i] = better;
    }
    solve.error /= static_cast<double>(count) * static_cast<double>(s.params.rest_density);
    if (k == iterations) break;
    for (std::size_t i = 0; i < count; ++i) solve.pressure[i] += change[i];
    push(r, neighbours, change, dt, solve.velocity);
  }
  return solve;
}

}  // namespace splash::sim
