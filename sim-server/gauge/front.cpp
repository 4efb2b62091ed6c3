// SPDX-License-Identifier: MIT
#include "sim-server/gauge/front.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

namespace splash::sim {

double front_position(const WaterState& water, std::size_t axis, double sign, double width) {
  std::vector<double> ahead;  // sign * coordinate, the farthest first
  ahead.reserve(water.position.size());
  for (const Vector3& x : water.position) ahead.push_back(sign * x[axis]);
  std::sort(ahead.begin(), ahead.end(), std::greater<>());
  const auto wanted =
      static_cast<std::size_t>(std::max(std::ceil(0.5 * width / water.spacing), 1.0));
  for (std::size_t first = 0; first + wanted <= ahead.size(); ++first) {
    if (ahead[first] - ahead[first + wanted - 1] > water.spacing) continue;
    return sign * (ahead[first] + water.spacing / 2.0);
  }
  return std::numeric_limits<double>::quiet_NaN();
}

}  // namespace splash::sim
