// SPDX-License-Identifier: MIT
// A body that a tracker moves while the simulation runs. Poses are kept by the moment they were
// taken at on the clock on the wall; each frame plays a piece of them. Simulated time may slip
// behind that clock: the pieces then are longer than the frame, but the speeds that are told are
// those on the wall.
#pragma once

#include <cstdint>
#include <mutex>
#include <vector>

#include "sim-server/bodies/motion/pose_fit.hpp"
#include "sim-server/bodies/motion/pose_gate.hpp"
#include "sim-server/bodies/motion/posed_motion.hpp"

namespace splash::sim {

/// What a body does without a new pose: it goes on at full speed for `coast`, or for two and a half
/// times the time between two poses where that is longer, and takes `fade` to stop. `hold`: it is
/// played a pose later, so that it never goes beyond one, and stays at the last.
struct LiveGap {
  double coast = 0.025;  ///< [s]
  double fade = 0.050;   ///< [s]
  bool hold = false;
};

class LiveMotion : public PosedMotion {
 public:
  /// `delay_limit`: poses that arrive unevenly are played later by as much as evens them out, but
  /// by no more [s].
  explicit LiveMotion(const Keyframe& rest, const LiveLimits& limits = {}, const LiveGap& gap = {},
                      double delay_limit = 0.030);

  PoseRefusal push(const Vector3& position, const Quaternion& rotation,
                   const PoseStamp& stamp) override;
  void begin(const PlayedFrame& frame) override;
  [[nodiscard]] BodyState at(double seconds) const override;

  /// How much later than they could be the poses are played [s].
  [[nodiscard]] double delay() const noexcept { return plan_.delay; }

 private:
  /// How a frame is played.
  struct Plan {
    bool seen = false;     ///< any pose; else the body is at rest
    double seconds = 0.0;  ///< simulated time at the frame's start [s]
    double start = 0.0;    ///< moment of the poses then [s]
    double rate = 1.0;     ///< of that moment in simulated time [1]
    double first = 0.0;    ///< moment of the oldest pose that is known [s]
    double last = 0.0;     ///< of the newest [s]
    double coast = 0.0;    ///< [s]
    double delay = 0.0;    ///< [s]
    PoseFit fit;
    Vector3 offset = {};         ///< of the frame before less this one, fades out [m]
    Vector3 turn_offset = {};    ///< the same of the rotation, in the world [rad]
    double fades = 1.0;          ///< its time constant [s]
    double slack = 0.0;          ///< what of its speed is not told [m/s]
    double turning_slack = 0.0;  ///< [rad/s]
  };

  /// Share of the velocity left `dt` after the last pose, and the time it has been going on at full
  /// speed instead.
  [[nodiscard]] double speed_left(double dt, double coast) const;
  [[nodiscard]] double way_gone(double dt, double coast) const;
  /// The fit to the poses around `moment`; speed and spin are no more than a body may have.
  [[nodiscard]] BodyState fitted(const Plan& plan, double moment) const;
  [[nodiscard]] BodyState played(const Plan& plan, double moment) const;
  [[nodiscard]] BodyState state(const Plan& plan, double seconds) const;
  void set_time(Plan& next, const PlayedFrame& frame, double lateness, double period) const;
  void set_offsets(Plan& next, bool jumped) const;

  Keyframe rest_;
  LiveLimits limits_;
  LiveGap gap_;
  double delay_limit_;
  Plan plan_;
  double wall_ = 0.0;  ///< when the last frame began [s]
  std::mutex mutex_;
  PoseClock clock_;  ///< under mutex_
  PoseGate gate_;    ///< same
};

}  // namespace splash::sim
