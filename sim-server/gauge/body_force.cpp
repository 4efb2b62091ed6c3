// SPDX-License-Identifier: MIT
#include "sim-server/gauge/body_force.hpp"

#include <algorithm>
#include <cmath>
#include <map>

#include "sim-server/fluid/smoothing.hpp"
#include "sim-server/scene/rotation.hpp"

namespace splash::sim {

namespace {

/// A point of the body in the world.
struct Placed {
  Vector3 place;     ///< [m]
  Vector3 velocity;  ///< [m/s]
  double volume;     ///< [m3]
};

using Cell = std::array<long, 3>;

Cell cell_of(const Vector3& place, double edge) {
  Cell cell = {};
  for (std::size_t i = 0; i < 3; ++i) cell[i] = std::lround(std::floor(place[i] / edge));
  return cell;
}

/// The body's points by cells as large as the support, and the cells' bounds.
struct PlacedBody {
  std::map<Cell, std::vector<Placed>> cells;
  Cell first = {};
  Cell last = {};

  [[nodiscard]] bool is_near(const Cell& cell) const {
    for (std::size_t i = 0; i < 3; ++i) {
      if (cell[i] < first[i] - 1 || cell[i] > last[i] + 1) return false;
    }
    return true;
  }
};

PlacedBody place_points(const WaterState& water, std::span<const BodyPoint> points, int owner,
                        const BodyState& state) {
  PlacedBody body;
  for (const BodyPoint& point : points) {
    if (point.owner != owner) continue;
    const Vector3 arm = rotate(state.rotation, point.place);
    const Placed placed = {state.position + arm, state.velocity + cross(state.spin, arm),
                           water.point_weight * point.volume};
    const Cell cell = cell_of(placed.place, water.support);
    const bool is_first = body.cells.empty();
    for (std::size_t i = 0; i < 3; ++i) {
      body.first[i] = is_first ? cell[i] : std::min(body.first[i], cell[i]);
      body.last[i] = is_first ? cell[i] : std::max(body.last[i], cell[i]);
    }
    body.cells[cell].push_back(placed);
  }
  return body;
}

/// On the body's point by particle i [N].
Vector3 push(const WaterState& water, std::size_t i, const Placed& point) {
  const Vector3 x = water.position[i] - point.place;
  const double r = length(x);
  if (r >= water.support) return {0.0, 0.0, 0.0};
  const double h = traits_of(water.smoothing).length * water.support;
  const double closing = dot(water.velocity[i] - point.velocity, x);
  const double rub = (water.viscous * closing + water.artificial * std::min(closing, 0.0)) /
                     (water.rest_density * (r * r + 0.01 * h * h));
  const double own = water.rise[i] * water.pressure[i] / (water.density[i] * water.density[i]);
  return water.mass * water.rest_density * point.volume * (own - rub) *
         kernel_gradient(r, water.kernel()) * x;
}

}  // namespace

BodyForce body_force(const WaterState& water, std::span<const BodyPoint> points, int owner,
                     const BodyState& state) {
  const PlacedBody body = place_points(water, points, owner, state);
  BodyForce total;
  for (std::size_t i = 0; i < water.position.size(); ++i) {
    const Cell home = cell_of(water.position[i], water.support);
    if (!body.is_near(home)) continue;
    for (int k = 0; k < 27; ++k) {
      const auto found =
          body.cells.find({home[0] + k % 3 - 1, home[1] + k / 3 % 3 - 1, home[2] + k / 9 - 1});
      if (found == body.cells.end()) continue;
      for (const Placed& point : found->second) {
        const Vector3 force = push(water, i, point);
        total.force = total.force + force;
        total.torque = total.torque + cross(point.place - state.position, force);
      }
    }
  }
  return total;
}

}  // namespace splash::sim
