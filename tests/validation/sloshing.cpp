// SPDX-License-Identifier: MIT
#include "tests/validation/sloshing.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>

#include "sim-server/scene/rotation.hpp"
#include "sim-server/scene/symmetric_matrix.hpp"

namespace splash::validation {

namespace {

using sim::Vector3;
using std::numbers::pi;

constexpr std::size_t kModes = 6;

using Weights = std::array<double, kModes>;

/// Of the n-th mode, 1 m/s at most at the level [m/s].
Vector3 velocity_of_mode(const Basin& basin, std::size_t n, const Vector3& x) {
  const double k = static_cast<double>(n) * pi / basin.length;
  const double top = std::cosh(k * basin.depth);
  return {std::sin(k * x[0]) * std::cosh(k * x[2]) / top, 0.0,
          -std::cos(k * x[0]) * std::sinh(k * x[2]) / top};
}

}  // namespace

Parts split(const Basin& basin, const std::vector<Vector3>& places,
            const std::vector<Vector3>& velocities) {
  sim::Matrix<kModes> products = {};  // its lower half
  Weights seen = {};
  double all = 0.0;
  for (std::size_t i = 0; i < places.size(); ++i) {
    std::array<Vector3, kModes> modes;
    for (std::size_t n = 0; n < kModes; ++n) {
      modes[n] = velocity_of_mode(basin, n + 1, places[i]);
      seen[n] += sim::dot(modes[n], velocities[i]);
      for (std::size_t m = 0; m <= n; ++m) products[n][m] += sim::dot(modes[n], modes[m]);
    }
    all += sim::dot(velocities[i], velocities[i]);
  }
  const Weights weights = sim::solve(products, seen);
  double sloshing = 0.0;
  for (std::size_t n = 0; n < kModes; ++n) sloshing += weights[n] * seen[n];
  const double count = static_cast<double>(places.size());
  return {std::sqrt(sloshing / count), std::sqrt(std::max(all - sloshing, 0.0) / count)};
}

// A layer takes sqrt(nu omega / 2) / 2 rho |u|^2 per area and time, which the mode's energy,
// rho / 2 the integral of |u|^2, pays for; amplitudes fall at half its rate. All of |u|^2 are over
// k^2.
double wall_decay(const Basin& basin, double viscosity, double gravity) {
  const double k = pi / basin.length;
  const double omega = std::sqrt(gravity * k * std::tanh(k * basin.depth));
  const double column = std::sinh(2.0 * k * basin.depth) / (2.0 * k);
  const double side = 0.5 * basin.length * column;
  const double floor = 0.5 * basin.length * basin.width;
  const double end = 0.5 * basin.width * (column - basin.depth);
  const double volume = basin.width * side;
  return 0.5 * std::sqrt(0.5 * viscosity * omega) * (2.0 * side + floor + 2.0 * end) / volume;
}

double swing_decay(const Column& time, const Column& y, double first) {
  const Column crossings = zero_crossings(time, y);
  const Column below = linear(-1.0, y);
  Column at;
  Column logarithm;
  for (std::size_t k = 0; k + 1 < crossings.size(); ++k) {
    if (crossings[k] < first) continue;
    at.push_back(0.5 * (crossings[k] + crossings[k + 1]));
    logarithm.push_back(
        std::log(std::max(largest_between(time, y, crossings[k], crossings[k + 1]),
                          largest_between(time, below, crossings[k], crossings[k + 1]))));
  }
  if (at.size() < 3) return std::nan("");
  return -fit_line(at, logarithm, at.front(), at.back()).second;
}

}  // namespace splash::validation
