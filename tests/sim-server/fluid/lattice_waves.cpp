// SPDX-License-Identifier: MIT
#include "tests/sim-server/fluid/lattice_waves.hpp"

#include <algorithm>
#include <cmath>

#include "sim-server/fluid/params/smoothing.hpp"
#include "sim-server/scene/rotation.hpp"

namespace splash::sim {
namespace {

/// |s(k)| / V [1/m4].
double steepness(const std::vector<Vector3>& places, double support, const Vector3& k) {
  Vector3 s = {};
  for (const Vector3& x : places) {
    s = s + std::sin(dot(k, x)) * kernel_gradient(length(x), support) * x;
  }
  return length(s);
}

}  // namespace

std::vector<Vector3> lattice(const std::vector<Vector3>& basis, double spacing, double reach) {
  const double edge = spacing * std::cbrt(static_cast<double>(basis.size()));
  std::vector<Vector3> places;
  constexpr int kFar = 4;
  for (int i = -kFar; i <= kFar; ++i) {
    for (int j = -kFar; j <= kFar; ++j) {
      for (int k = -kFar; k <= kFar; ++k) {
        for (const Vector3& b : basis) {
          const Vector3 x = {(i + b[0]) * edge, (j + b[1]) * edge, (k + b[2]) * edge};
          const double r = length(x);
          if (r > 1.0e-9 && r < reach) places.push_back(x);
        }
      }
    }
  }
  return places;
}

double steepest_wave(const std::vector<Vector3>& places, double volume, double support) {
  constexpr int kStarts = 7;
  const double unit = 1.0 / std::cbrt(volume);
  double best = 0.0;
  for (int start = 0; start < kStarts * kStarts * kStarts; ++start) {
    const auto at = [&](int part) { return 6.5 * unit * (part % kStarts) / (kStarts - 1.0); };
    Vector3 k = {at(start), at(start / kStarts), at(start / kStarts / kStarts)};
    double here = steepness(places, support, k);
    for (double step = 0.5 * unit; step > 1.0e-3 * unit; step /= 2.0) {
      for (std::size_t a = 0; a < 6; ++a) {
        Vector3 next = k;
        next[a / 2] += a % 2 == 0 ? step : -step;
        const double there = steepness(places, support, next);
        if (!(there > here)) continue;
        here = there;
        k = next;
      }
    }
    best = std::max(best, here);
  }
  return volume * best;
}

}  // namespace splash::sim
