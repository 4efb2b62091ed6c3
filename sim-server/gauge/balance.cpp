// SPDX-License-Identifier: MIT
#include "sim-server/gauge/balance.hpp"

#include <algorithm>
#include <cmath>

#include "sim-server/scene/rotation.hpp"

namespace splash::sim {
namespace {

constexpr auto kStretchStiffness = static_cast<double>(SPLASH_STRETCH_STIFFNESS);

}  // namespace

double compression_energy(const WaterState& water, double density, double peak) {
  const double sound2 = water.sound_speed * water.sound_speed;
  const double stretch = std::max(peak - density, 0.0) / water.rest_density;
  if (density <= water.rest_density) return 0.5 * kStretchStiffness * sound2 * stretch * stretch;
  const double push = water.rest_density / density - 1.0;
  // ln(rho/rho0) = -log1p(push): no difference of numbers close to one.
  return sound2 * (push - std::log1p(push));
}

Energies energies(const WaterState& water) {
  Energies sum;
  for (std::size_t i = 0; i < water.position.size(); ++i) {
    sum.kinetic += 0.5 * water.mass * dot(water.velocity[i], water.velocity[i]);
    sum.potential +=
        water.mass * water.potential_at(water.position[i] - water.lag * water.velocity[i]);
    sum.compression +=
        water.mass * compression_energy(water, water.density[i], water.peak_density[i]);
  }
  return sum;
}

Momentum momentum(const WaterState& water) {
  Momentum result;
  double square = 0.0;
  for (const Vector3& v : water.velocity) {
    result.sum = result.sum + water.mass * v;
    square += dot(v, v);
    result.fastest = std::max(result.fastest, length(v));
  }
  result.rms =
      std::sqrt(square / std::max<double>(1.0, static_cast<double>(water.velocity.size())));
  return result;
}

Spread spread(const WaterState& water) {
  Spread result;
  if (water.position.empty()) return result;
  const double share = 1.0 / static_cast<double>(water.position.size());
  for (const Vector3& x : water.position) result.centre = result.centre + share * x;
  for (std::size_t axis = 0; axis < 3; ++axis) {
    double square = 0.0;
    for (const Vector3& x : water.position) {
      const double from = x[axis] - result.centre[axis];
      square += from * from;
    }
    result.deviation[axis] = std::sqrt(share * square);
  }
  return result;
}

}  // namespace splash::sim
