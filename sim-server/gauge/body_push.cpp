// SPDX-License-Identifier: MIT
#include "sim-server/gauge/body_push.hpp"

#include <algorithm>
#include <cmath>

#include "sim-server/fluid/params/smoothing.hpp"
#include "sim-server/scene/rotation.hpp"

namespace splash::sim {
namespace {

/// On the body's point by particle i, r [m] away [N].
Vector3 push(const WaterState& water, std::size_t i, const PlacedPoint& point) {
  const Vector3 x = water.position[i] - point.place;
  const double r = length(x);
  const double h = kLengthOfSupport * water.support;
  const double closing = dot(water.velocity[i] - point.velocity, x);
  const double rub = (water.viscous * closing + water.artificial * std::min(closing, 0.0)) /
                     (water.rest_density * (r * r + 0.01 * h * h));
  const double own = water.pressure[i] / (water.density[i] * water.density[i]);
  const Vector3 along = (water.image[i] * own - rub) * kernel_gradient(r, water.support) * x;
  const Vector3 nearing = own * kernel_value(r, water.support) * water.slope[i];
  return water.mass * water.rest_density * point.volume * (along + nearing);
}

}  // namespace

PlacedBody::Cell PlacedBody::cell_of(const Vector3& place, double edge) {
  Cell cell = {};
  for (std::size_t i = 0; i < 3; ++i) cell[i] = std::lround(std::floor(place[i] / edge));
  return cell;
}

PlacedBody::PlacedBody(const WaterState& water, std::span<const BodyPoint> points, int owner,
                       const BodyState& state) {
  for (const BodyPoint& point : points) {
    if (point.owner != owner) continue;
    const Vector3 arm = rotate(state.rotation, point.place);
    const PlacedPoint placed = {state.position + arm, state.velocity + cross(state.spin, arm),
                                water.point_weight * point.volume};
    const Cell cell = cell_of(placed.place, water.support);
    const bool is_first = cells_.empty();
    for (std::size_t i = 0; i < 3; ++i) {
      first_[i] = is_first ? cell[i] : std::min(first_[i], cell[i]);
      last_[i] = is_first ? cell[i] : std::max(last_[i], cell[i]);
    }
    cells_[cell].push_back(placed);
  }
}

bool PlacedBody::is_near(const Cell& cell) const {
  for (std::size_t i = 0; i < 3; ++i) {
    if (cell[i] < first_[i] - 1 || cell[i] > last_[i] + 1) return false;
  }
  return true;
}

void PlacedBody::each_push(
    const WaterState& water,
    const std::function<void(std::size_t, const PlacedPoint&, const Vector3&)>& visit) const {
  for (std::size_t i = 0; i < water.position.size(); ++i) {
    const Cell home = cell_of(water.position[i], water.support);
    if (!is_near(home)) continue;
    for (int k = 0; k < 27; ++k) {
      const auto found =
          cells_.find({home[0] + k % 3 - 1, home[1] + k / 3 % 3 - 1, home[2] + k / 9 - 1});
      if (found == cells_.end()) continue;
      for (const PlacedPoint& point : found->second) {
        if (length(water.position[i] - point.place) >= water.support) continue;
        visit(i, point, push(water, i, point));
      }
    }
  }
}

BodyForce body_force(const WaterState& water, std::span<const BodyPoint> points, int owner,
                     const BodyState& state) {
  BodyForce total;
  PlacedBody(water, points, owner, state)
      .each_push(water, [&](std::size_t i, const PlacedPoint&, const Vector3& force) {
        total.force = total.force + force;
        total.torque = total.torque + cross(water.position[i] - state.position, force);
      });
  return total;
}

}  // namespace splash::sim
