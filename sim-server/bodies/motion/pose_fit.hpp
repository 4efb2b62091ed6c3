// SPDX-License-Identifier: MIT
// Where a body is and how it moves at a moment, from the poses around that moment.
#pragma once

#include <vector>

#include "sim-server/bodies/motion/motion.hpp"

namespace splash::sim {

/// A pose and when it was taken.
struct TimedPose {
  double time = 0.0;      ///< by our clock [s]
  Vector3 position = {};  ///< [m]
  Quaternion rotation = {0.0, 0.0, 0.0, 1.0};
};

/// What is known of the poses.
struct PoseQuality {
  double period = 0.0;  ///< between two poses, of late [s]
  double doubt = 0.0;   ///< how wrong their moments may be [s]
  double speed = 0.0;   ///< of the body, about [m/s]
  double spin = 0.0;    ///< same [rad/s]
};

/// A parabola of time along each axis and for the turn.
class PoseFit {
 public:
  PoseFit() = default;
  /// Of least squares through `poses`, in order of time and at least one, weighted by their
  /// distance from `time`. Accelerations are held back by as much as the poses are uncertain, so
  /// that noise makes no speed.
  PoseFit(const std::vector<TimedPose>& poses, double time, const PoseQuality& quality);

  /// Best near the time of the fit.
  [[nodiscard]] BodyState at(double time) const;

 private:
  double time_ = 0.0;
  Vector3 position_ = {};
  Vector3 velocity_ = {};      ///< [m/s]
  Vector3 acceleration_ = {};  ///< [m/s2]
  Quaternion reference_ = {0.0, 0.0, 0.0, 1.0};
  Vector3 turn_ = {};       ///< from the reference, in the world [rad]
  Vector3 spin_ = {};       ///< [rad/s]
  Vector3 spin_gain_ = {};  ///< [rad/s2]
};

}  // namespace splash::sim
