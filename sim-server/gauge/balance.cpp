// SPDX-License-Identifier: MIT
#include "sim-server/gauge/balance.hpp"

#include <algorithm>
#include <cmath>

#include "sim-server/scene/rotation.hpp"

namespace splash::sim {

double compression_energy(double density, double rest_density, double sound_speed) {
  if (density <= rest_density) return 0.0;
  const double stretch = rest_density / density - 1.0;
  // ln(rho/rho0) = -log1p(stretch): no difference of numbers close to one.
  return sound_speed * sound_speed * (stretch - std::log1p(stretch));
}

Energies energies(const WaterState& water) {
  Energies sum;
  for (std::size_t i = 0; i < water.position.size(); ++i) {
    sum.kinetic += 0.5 * water.mass * dot(water.velocity[i], water.velocity[i]);
    sum.potential += water.mass * water.potential_at(water.position[i]);
    sum.compression +=
        water.mass * compression_energy(water.density[i], water.rest_density, water.sound_speed);
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
