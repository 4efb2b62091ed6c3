// SPDX-License-Identifier: MIT
// A body that can take poses while the simulation runs.
#pragma once

#include "sim-server/bodies/motion/motion.hpp"
#include "sim-server/bodies/motion/pose_clock.hpp"
#include "sim-server/bodies/motion/pose_refusal.hpp"

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
  /// Starts a frame: until the next one, `at` uses the poses received so far.
  virtual void begin(const PlayedFrame& frame) = 0;
  /// From now on it follows its poses, or its own motion.
  virtual void grab(bool /*on*/) {}
  /// Its own motion begins anew at `seconds` of simulated time.
  virtual void restart(double /*seconds*/) {}
  /// True while poses move a body that also has a motion of its own.
  [[nodiscard]] virtual bool is_held() const noexcept { return false; }
  /// True for a body that only poses move.
  [[nodiscard]] virtual bool is_tracked() const noexcept { return true; }
};

}  // namespace splash::sim
