// SPDX-License-Identifier: MIT
#include "tests/detection/run_water.hpp"

#include <algorithm>
#include <array>
#include <cmath>

#include "sim-server/scene/rotation.hpp"

namespace splash::detection {
namespace {

using namespace sim;  // operators of vectors among it

/// A surface of particles is known to this [spacings].
constexpr double kTouching = 0.1;

SurfaceDistance distance_of(const FluidParams& p) {
  return {static_cast<double>(p.spacing), static_cast<double>(p.support),
          static_cast<double>(p.layer_weight)};
}

}  // namespace

RunWater::RunWater(Simulation& simulation, double reach)
    : params_(simulation.fluid().params()),
      tank_(simulation.scene().tank),
      reach_(reach),
      state_(simulation.fluid().snapshot()),
      distance_(distance_of(params_)),
      kernel_(static_cast<double>(params_.support)) {
  const auto count = static_cast<std::size_t>(params_.count);
  for (std::size_t axis = 0; axis < 3; ++axis) {
    cells_[axis] = cell_along(axis, tank_.upper[axis]) + 1;
  }
  from_.assign(
      static_cast<std::size_t>(cells_[0] * cells_[1]) * static_cast<std::size_t>(cells_[2]) + 1, 0);
  std::vector<std::size_t> cell(count);
  for (std::size_t i = 0; i < count; ++i) {
    int at = 0;
    for (std::size_t axis = 3; axis-- > 0;) {
      const double x = static_cast<double>(
          state_.position[axis * static_cast<std::size_t>(params_.capacity) + i]);
      at = at * cells_[axis] + std::clamp(cell_along(axis, x), 0, cells_[axis] - 1);
    }
    cell[i] = static_cast<std::size_t>(at);
    ++from_[cell[i] + 1];
  }
  for (std::size_t c = 1; c < from_.size(); ++c) from_[c] += from_[c - 1];
  list_.resize(count);
  std::vector<int> next = from_;
  for (std::size_t i = 0; i < count; ++i) {
    list_[static_cast<std::size_t>(next[cell[i]]++)] = static_cast<int>(i);
  }
}

int RunWater::cell_along(std::size_t axis, double at) const {
  return static_cast<int>(
      std::floor((at - tank_.lower[axis]) / static_cast<double>(params_.support)));
}

RunWater::Seen RunWater::see(const Vector3& place) const {
  const auto stride = static_cast<std::size_t>(params_.capacity);
  const double volume =
      static_cast<double>(params_.mass) / static_cast<double>(params_.rest_density);
  std::array<int, 3> low = {};
  std::array<int, 3> high = {};
  for (std::size_t axis = 0; axis < 3; ++axis) {
    const int c = cell_along(axis, place[axis]);
    low[axis] = std::clamp(c - 1, 0, cells_[axis] - 1);
    high[axis] = std::clamp(c + 1, 0, cells_[axis] - 1);
  }
  Seen seen;
  for (int z = low[2]; z <= high[2]; ++z) {
    for (int y = low[1]; y <= high[1]; ++y) {
      const auto row =
          static_cast<std::size_t>(z * cells_[1] + y) * static_cast<std::size_t>(cells_[0]);
      const int first = from_[row + static_cast<std::size_t>(low[0])];
      const int last = from_[row + static_cast<std::size_t>(high[0]) + 1];
      for (int k = first; k < last; ++k) {
        const auto i = static_cast<std::size_t>(list_[static_cast<std::size_t>(k)]);
        const auto part = [&](const std::vector<float>& v) {
          return Vector3{static_cast<double>(v[i]), static_cast<double>(v[stride + i]),
                         static_cast<double>(v[2 * stride + i])};
        };
        const Vector3 apart = place - part(state_.position);
        const double weight = volume * kernel_.of_square(dot(apart, apart));
        if (weight <= 0.0) continue;
        seen.colour += weight;
        seen.velocity = seen.velocity + weight * part(state_.velocity);
      }
    }
  }
  if (seen.colour > 0.0) seen.velocity = (1.0 / seen.colour) * seen.velocity;
  return seen;
}

double RunWater::matter(const Vector3& place) const {
  double all = see(place).colour;
  for (std::size_t axis = 0; axis < 3; ++axis) {
    const double depth = std::min(place[axis] - tank_.lower[axis], tank_.upper[axis] - place[axis]);
    if (depth <= 0.0) return 1.0;
    if (depth < static_cast<double>(params_.support)) all += distance_.colour_at(depth);
  }
  return std::min(all, 1.0);
}

Water RunWater::water(double clear) const {
  Water water;
  water.touching = kTouching * distance_.spacing();
  water.clear = clear;
  water.at = [this](const Vector3& place) {
    const Seen seen = see(place);
    return Met{distance_.distance_for(seen.colour), seen.velocity};
  };
  water.ahead = [this](const Vector3& place, const Vector3& normal) {
    return matter(place + reach_ * normal);
  };
  return water;
}

}  // namespace splash::detection
