// SPDX-License-Identifier: MIT
// Keeps simulated time on the wall clock. A simulator that falls behind by more than a limit lets
// simulated time slip: what it missed is given up, it never races to catch up a growing backlog.
#pragma once

#include <cstdint>
#include <functional>

namespace splash::sim {

/// The clocks of the machine; tests bring their own.
struct PacerClock {
  std::function<double()> monotonic;        ///< [s]
  std::function<double()> unix_time;        ///< [s]
  std::function<void(double)> sleep_until;  ///< monotonic [s]; may wake early
  [[nodiscard]] static PacerClock system();
};

struct PacerSettings {
  bool real_time = true;      ///< false: faster than real time, no waiting
  double grace = 0.001;       ///< a frame is "behind" when later than this [s]
  double slip_limit = 0.100;  ///< time slips when behind by more than this [s]
};

struct PacerCounts {
  std::uint64_t frames = 0;
  std::uint64_t behind = 0;  ///< frames that were ready later than their moment plus the grace
  double most_behind = 0.0;  ///< the latest frame [s]
  std::uint64_t slips = 0;
  double slipped = 0.0;  ///< simulated time is this much later than it would be [s]
};

class Pacer {
 public:
  explicit Pacer(PacerSettings settings = {}, PacerClock clock = PacerClock::system());

  /// Simulated time `seconds` is now. Call when the first frame starts (compiling is over), and
  /// after every pause.
  void start(double seconds = 0.0);
  /// Call when a frame is computed, before its events are sent: waits for its moment, or notes
  /// that it is over.
  void wait_until(double seconds);

  /// Time slips when behind by more than this [s].
  void set_slip_limit(double seconds) noexcept { settings_.slip_limit = seconds; }

  /// Our monotonic clock when simulated second 0 was, slips included [s]. It never runs back.
  [[nodiscard]] double origin() const noexcept { return origin_; }
  /// Unix time at which simulated second 0 was, slips included [s]: what FrameTime wants. Read it
  /// for each frame, since slips and corrections of the system clock move it.
  [[nodiscard]] double unix_origin() const;
  [[nodiscard]] const PacerCounts& counts() const noexcept { return counts_; }

 private:
  PacerSettings settings_;
  PacerClock clock_;
  double origin_ = 0.0;  ///< monotonic time of simulated second 0 [s]
  PacerCounts counts_;
};

}  // namespace splash::sim
