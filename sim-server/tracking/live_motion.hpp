// SPDX-License-Identifier: MIT
// A body that a tracker moves while the simulation runs: poses come when they come, the state is
// asked for at any time in between. Position and turn never jump with a new pose: what the
// prediction was wrong by fades out (dead reckoning), and without poses the body slows to a stop.
#pragma once

#include <cstdint>
#include <deque>
#include <mutex>
#include <string_view>

#include "sim-server/tracking/motion.hpp"

namespace splash::sim {

enum class PoseRefusal : std::uint8_t {
  none,
  not_finite,     ///< a number is NaN or infinite
  no_rotation,    ///< the quaternion's length is (almost) zero
  too_far,        ///< a place beyond the limit
  too_fast,       ///< a speed or spin beyond the limit since the pose before
  time_ran_back,  ///< arrived before the pose before
};
[[nodiscard]] std::string_view describe(PoseRefusal refusal) noexcept;

struct LiveLimits {
  double place = 100.0;  ///< any coordinate [m]
  double speed = 20.0;   ///< [m/s]; the fastest sprint's foot
  double spin = 100.0;   ///< [rad/s]
};

/// Without a new pose a body goes on at full speed for `coast` and takes `fade` to stop; both zero:
/// it stays where it was seen.
struct LiveGap {
  double coast = 0.025;  ///< [s]
  double fade = 0.050;   ///< [s]
};

/// `push` and `at` may be called from different threads.
class LiveMotion : public Motion {
 public:
  explicit LiveMotion(const Keyframe& rest, const LiveLimits& limits = {}, const LiveGap& gap = {});

  /// A pose that arrived at `arrival` seconds on the clock of `at`. Quaternions need not have
  /// unit length.
  PoseRefusal push(const Vector3& position, const Quaternion& rotation, double arrival);
  [[nodiscard]] BodyState at(double seconds) const override;

 private:
  /// From one pose until the next: the motion goes on as it was, and stops.
  struct Stretch {
    double time = 0.0;
    Vector3 position = {};
    Quaternion rotation = {0.0, 0.0, 0.0, 1.0};
    Vector3 velocity = {};
    Vector3 spin = {};         ///< in the world [rad/s]
    Vector3 offset = {};       ///< prediction minus pose, fades out [m]
    Vector3 turn_offset = {};  ///< the same for the rotation, in the world [rad]
  };

  /// Share of the velocity left `dt` after a pose, and the time it has been going on at full speed
  /// instead.
  [[nodiscard]] double speed_left(double dt) const;
  [[nodiscard]] double way_gone(double dt) const;
  [[nodiscard]] BodyState state(const Stretch& stretch, double time) const;
  [[nodiscard]] BodyState predict(double time) const;
  [[nodiscard]] PoseRefusal check(const Vector3& position, const Quaternion& rotation,
                                  double arrival) const;
  void set_velocities(Stretch& next) const;
  void set_offsets(Stretch& next) const;

  Keyframe rest_;
  LiveLimits limits_;
  LiveGap gap_;
  mutable std::mutex mutex_;
  std::deque<Stretch> stretches_;
};

}  // namespace splash::sim
