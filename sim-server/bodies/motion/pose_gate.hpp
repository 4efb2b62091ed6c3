// SPDX-License-Identifier: MIT
// Which poses a body can have followed, and those of late in order of time. A jump of a frame or
// two that comes back is none; one that stays is a body found elsewhere.
#pragma once

#include <vector>

#include "sim-server/bodies/motion/pose_fit.hpp"
#include "sim-server/bodies/motion/pose_refusal.hpp"

namespace splash::sim {

struct LiveLimits {
  double place = 100.0;  ///< any coordinate [m]
  double speed = 20.0;   ///< [m/s]; the fastest sprint's foot
  double spin = 100.0;   ///< [rad/s]
};

class PoseGate {
 public:
  explicit PoseGate(const LiveLimits& limits = {}) : limits_(limits) {}

  /// Whether numbers are any pose's.
  [[nodiscard]] PoseRefusal look_at(const Vector3& position, const Quaternion& rotation) const;
  /// Takes a pose with a rotation of unit length, or not. `doubt`, `scatter`: how wrong
  /// its moment is likely and may be; poses within `instant` of each other are one [s].
  PoseRefusal take(const TimedPose& pose, double doubt, double scatter, double instant);

  /// In order of time, of the last half second at least; the first one alone stays for ever.
  [[nodiscard]] const std::vector<TimedPose>& poses() const noexcept { return poses_; }
  /// Mean time between the last poses [s]; 0: unknown.
  [[nodiscard]] double period() const noexcept;
  /// Whether the body was found elsewhere since this was last asked.
  [[nodiscard]] bool has_jumped() noexcept;

 private:
  [[nodiscard]] PoseRefusal compare(const TimedPose& pose, double doubt, double scatter) const;
  PoseRefusal suspect(const TimedPose& pose, PoseRefusal reason);
  void insert(const TimedPose& pose, double instant);

  LiveLimits limits_;
  std::vector<TimedPose> poses_;
  std::vector<TimedPose> suspects_;  ///< off the body's motion, one near the other
  bool jumped_ = false;
};

}  // namespace splash::sim
