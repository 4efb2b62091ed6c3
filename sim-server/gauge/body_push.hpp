// SPDX-License-Identifier: MIT
// What the water does to each point of a body: the reaction to what the points do to the particles
// around them in fluid/pressure/acceleration.cl, in double precision. A force acts at the
// particle's place. R and its gradient: fluid/boundary/body_image.h; of a particle between two
// bodies each gets the part of its own points.
//   f_ib = m rho0 V_b (p_i / rho_i^2 (R_i grad W_ib + W_ib grad R_i) - pi_ib grad W_ib)
//   pi_ib = (10 nu v.x + alpha c0 h min(v.x, 0)) / (rho0 (r^2 + 0.01 h^2)), h = 0.4 H
#pragma once

#include <array>
#include <functional>
#include <map>
#include <span>
#include <vector>

#include "sim-server/bodies/body_points.hpp"
#include "sim-server/bodies/body_steps.hpp"
#include "sim-server/bodies/motion/motion.hpp"
#include "sim-server/gauge/water_state.hpp"

namespace splash::sim {

/// A point of a body in the world.
struct PlacedPoint {
  Vector3 place;     ///< [m]
  Vector3 velocity;  ///< [m/s]
  double volume;     ///< [m3]
};

/// A body's points by cells as large as the support.
class PlacedBody {
 public:
  /// `points`: of all bodies, those of `owner` count; `state`: that body's.
  PlacedBody(const WaterState& water, std::span<const BodyPoint> points, int owner,
             const BodyState& state);

  /// Calls `visit` for each particle and each point within the support: the particle, the point,
  /// and the force on the point [N]. `water` has pressures.
  void each_push(
      const WaterState& water,
      const std::function<void(std::size_t, const PlacedPoint&, const Vector3&)>& visit) const;

 private:
  using Cell = std::array<long, 3>;

  [[nodiscard]] static Cell cell_of(const Vector3& place, double edge);
  [[nodiscard]] bool is_near(const Cell& cell) const;

  std::map<Cell, std::vector<PlacedPoint>> cells_;
  Cell first_ = {};
  Cell last_ = {};
};

/// The force of the water on a body: the sum of what it does to the body's points. `water` has
/// pressures; `points`: of all bodies, those of `owner` count; `state`: that body's.
[[nodiscard]] BodyForce body_force(const WaterState& water, std::span<const BodyPoint> points,
                                   int owner, const BodyState& state);

}  // namespace splash::sim
