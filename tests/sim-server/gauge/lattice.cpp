// SPDX-License-Identifier: MIT
#include "tests/sim-server/gauge/lattice.hpp"
#include "sim-server/fluid/params/smoothing.hpp"

#include <cmath>

namespace splash::sim {

WaterState lattice_water(const Vector3& lower, const Vector3& upper, double spacing,
                         const std::function<bool(const Vector3&)>& inside) {
  WaterState water;
  water.spacing = spacing;
  water.support = kSupportSpacings * spacing;
  water.rest_density = 1000.0;
  water.mass = 1000.0 * spacing * spacing * spacing;
  water.sound_speed = 20.0;
  water.gravity = {0.0, 0.0, -9.81};
  const auto count = [&](std::size_t axis) {
    return static_cast<int>(std::lround((upper[axis] - lower[axis]) / spacing));
  };
  for (int k = 0; k < count(2); ++k) {
    for (int j = 0; j < count(1); ++j) {
      for (int i = 0; i < count(0); ++i) {
        const Vector3 place = {lower[0] + (i + 0.5) * spacing, lower[1] + (j + 0.5) * spacing,
                               lower[2] + (k + 0.5) * spacing};
        if (inside(place)) water.position.push_back(place);
      }
    }
  }
  water.velocity.resize(water.position.size(), {0.0, 0.0, 0.0});
  return water;
}

WaterState lattice_water(const Vector3& lower, const Vector3& upper, double spacing) {
  return lattice_water(lower, upper, spacing, [](const Vector3&) { return true; });
}

}  // namespace splash::sim
