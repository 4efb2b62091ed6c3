// SPDX-License-Identifier: MIT
// Where all bodies are in each step of a frame, as the kernels read it.
#pragma once

#include <memory>
#include <vector>

#include "sim-server/bodies/body_points.hpp"
#include "sim-server/fluid/fluid_params.h"
#include "sim-server/tracking/motion.hpp"

namespace splash::sim {

/// Speed of a body's fastest point, at most: as if it reached to its box's corners [m/s].
[[nodiscard]] float fastest_point(const BodyStep& body) noexcept;

/// The bodies of a scene with what moves them.
class Bodies {
 public:
  Bodies(std::vector<BodyPoint> points, std::vector<std::unique_ptr<Motion>> motions,
         double support);

  [[nodiscard]] const std::vector<BodyPoint>& points() const noexcept { return points_; }
  [[nodiscard]] std::size_t count() const noexcept { return motions_.size(); }
  [[nodiscard]] BodyState state(std::size_t body, double seconds) const;
  /// One entry per body at `seconds`, its box grown by the support.
  [[nodiscard]] std::vector<BodyStep> at(double seconds) const;
  /// The fastest any point of any body moves at `seconds` [m/s].
  [[nodiscard]] double fastest(double seconds) const;
  /// The fastest any body's centre will ever move, of those whose motion is known beforehand [m/s].
  [[nodiscard]] double fastest_ever() const;

 private:
  std::vector<BodyPoint> points_;
  std::vector<std::unique_ptr<Motion>> motions_;
  std::vector<double> reach_;  ///< largest distance of a point from its body's centre [m]
  double support_ = 0.0;
};

}  // namespace splash::sim
