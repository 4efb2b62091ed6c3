// SPDX-License-Identifier: MIT
#include "sim-server/gauge/pressure.hpp"

#include <algorithm>
#include <cmath>

#include "sim-server/fluid/params/smoothing.hpp"
#include "sim-server/scene/rotation.hpp"

namespace splash::sim {

namespace {

/// Colour below which a point counts as dry. On a flat surface it is 0.5, at a wall as much.
constexpr double kDry = 0.1;

}  // namespace

double pressure_at(const WaterState& water, const Vector3& place) {
  double weight = 0.0;
  double sum = 0.0;
  for (std::size_t j = 0; j < water.position.size(); ++j) {
    const Vector3 from = place - water.position[j];
    const double r2 = dot(from, from);
    if (r2 >= water.support * water.support) continue;
    const double w = kernel_value(std::sqrt(r2), water.support);
    weight += w;
    sum +=
        w * (water.pressure[j] + water.rest_density * dot(water.field_at(water.position[j]), from));
  }
  if (water.volume() * weight < kDry) return 0.0;
  return std::max(sum / weight, 0.0);
}

}  // namespace splash::sim
