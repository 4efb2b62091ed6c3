// SPDX-License-Identifier: MIT
// Where all bodies are in each step of a frame, as the kernels read it.
#pragma once

#include <memory>
#include <vector>

#include "sim-server/bodies/body_points.hpp"
#include "sim-server/bodies/motion/free_motion.hpp"
#include "sim-server/bodies/motion/motion.hpp"
#include "sim-server/fluid/params/fluid_params.h"

namespace splash::sim {

/// Speed of a body's fastest point, at most: as if it reached to its box's corners [m/s].
[[nodiscard]] float fastest_point(const BodyStep& body) noexcept;

/// A body's state from a step's entry.
[[nodiscard]] BodyState state_of(const BodyStep& step) noexcept;

/// Of the water on a body.
struct BodyForce {
  Vector3 force = {0.0, 0.0, 0.0};   ///< [N]
  Vector3 torque = {0.0, 0.0, 0.0};  ///< about the body's centre [N m]
};

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
  /// A tracker's new poses put a body that was at `before` to where it is at `seconds`: where it
  /// jumped by more than the support, it grows there from a point on, as fast as in a plunge.
  void note_jump(std::size_t body, const BodyState& before, double seconds);
  /// The fastest any point of any body moves at `seconds` [m/s].
  [[nodiscard]] double fastest(double seconds) const;
  /// The fastest any body's centre will ever move, of those whose motion is known beforehand [m/s].
  [[nodiscard]] double fastest_ever() const;
  /// Index of the body whose centre is nearest to `place` at `seconds`, -1 without bodies.
  [[nodiscard]] int nearest(const Vector3& place, double seconds) const;

  /// Whether the water moves the body.
  [[nodiscard]] bool is_free(std::size_t body) const noexcept { return free_[body] != nullptr; }
  /// Where a free body is at `seconds`, and what the water did to it in the last step.
  void put(std::size_t body, const BodyState& state, const BodyForce& force, double seconds);
  /// Stores the force of the water on a body that is not free, where it is measured.
  void note_force(std::size_t body, const BodyForce& force) { force_[body] = force; }
  /// The last force given with these; none before the first.
  [[nodiscard]] const BodyForce& force(std::size_t body) const noexcept { return force_[body]; }
  /// Free bodies go on at `seconds` from where they are; `still`: and stop.
  void hold(double seconds, bool still);
  /// Stops a free body.
  void zero_velocities(std::size_t body) noexcept { free_[body]->zero_velocities(); }
  /// Free bodies are where they were when time began; the others appear where they have gone since.
  void reset(double seconds);
  /// Whether a free body has moved within the last second: only then it is at rest.
  [[nodiscard]] bool restless(double seconds) const noexcept;

 private:
  std::vector<BodyPoint> points_;
  std::vector<std::unique_ptr<Motion>> motions_;
  std::vector<FreeMotion*> free_;  ///< of each body, null if it is none
  std::vector<BodyForce> force_;
  std::vector<double> moved_at_;  ///< when it was last seen to move [s]
  /// Whether it has not grown to its size yet.
  [[nodiscard]] bool appears(std::size_t body, double seconds) const;

  std::vector<BodyState> start_;     ///< when time began
  std::vector<double> appeared_at_;  ///< when it last jumped [s]
  std::vector<double> reach_;        ///< largest distance of a point from its body's centre [m]
  double support_ = 0.0;
};

}  // namespace splash::sim
