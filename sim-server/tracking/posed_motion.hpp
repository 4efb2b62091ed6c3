// SPDX-License-Identifier: MIT
// A body that can take poses while the simulation runs.
#pragma once

#include "sim-server/tracking/motion.hpp"
#include "sim-server/tracking/pose_clock.hpp"
#include "sim-server/tracking/pose_refusal.hpp"

namespace splash::sim {

/// A piece of time, on both clocks.
struct PlayedFrame {
  double seconds = 0.0;  ///< simulated time at its start [s]
  double wall = 0.0;     ///< our clock then [s]
  double length = 0.0;   ///< simulated [s]
};

/// `push` and `grab` may be called from another thread than the rest.
class PosedMotion : public Motion {
 public:
  /// Quaternions need not have unit length.
  virtual PoseRefusal push(const Vector3& position, const Quaternion& rotation,
                           const PoseStamp& stamp) = 0;
  /// What came until now is what `at` knows until the next frame begins.
  virtual void begin(const PlayedFrame& frame) = 0;
  /// From now on it follows its poses, or its own motion.
  virtual void grab(bool /*on*/) {}
  /// Whether poses move it now that else follows its own motion.
  [[nodiscard]] virtual bool is_held() const noexcept { return false; }
  /// Whether poses alone move it.
  [[nodiscard]] virtual bool is_tracked() const noexcept { return true; }
};

}  // namespace splash::sim
