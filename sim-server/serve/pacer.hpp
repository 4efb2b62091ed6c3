// SPDX-License-Identifier: MIT
// Simulated time on the wall clock: kept there, and how fast it goes.
#pragma once

#include <cstdint>
#include <deque>
#include <functional>

namespace splash::sim {

// Keeps simulated time on the wall clock. When the simulator falls behind by more than a limit,
// simulated time slips: the missed time is given up, and no backlog is caught up.

/// The machine's clocks; tests replace them.
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
  std::uint64_t behind = 0;  ///< frames that were ready later than their moment plus the grace
  double most_behind = 0.0;  ///< the latest frame [s]
  double slipped = 0.0;      ///< simulated time is this much later than it would be [s]
};

class Pacer {
 public:
  explicit Pacer(PacerSettings settings = {}, PacerClock clock = PacerClock::system());

  /// Makes simulated time `seconds` the present moment. To be called when the first frame starts,
  /// after kernels were compiled, and after every pause.
  void start(double seconds = 0.0);
  /// Waits for a frame's moment, or takes note that it has passed. To be called when the frame is
  /// computed, before its events are sent.
  void wait_until(double seconds);

  /// Sets how far simulated time may fall behind before it slips [s].
  void set_slip_limit(double seconds) noexcept { settings_.slip_limit = seconds; }

  /// The monotonic clock at simulated second 0, slips included [s]. It never decreases.
  [[nodiscard]] double origin() const noexcept { return origin_; }
  /// Unix time at simulated second 0, slips included [s]. To be read for each frame, since slips
  /// and corrections of the system clock change it.
  [[nodiscard]] double unix_origin() const;
  [[nodiscard]] const PacerCounts& counts() const noexcept { return counts_; }

 private:
  PacerSettings settings_;
  PacerClock clock_;
  double origin_ = 0.0;  ///< monotonic time of simulated second 0 [s]
  PacerCounts counts_;
};

// The speed of the simulation over the last second, in contrast to its mean since the start.

class RecentPace {
 public:
  /// `window`: of wall time, over which the rates are taken [s].
  explicit RecentPace(double window = 1.0) noexcept : window_(window) {}

  /// To be called at the end of each frame with the wall clock, simulated time [s] and the number
  /// of steps so far.
  void note(double wall, double simulated, std::int64_t steps);

  /// Simulated time per wall time [1]; 0 before the second frame.
  [[nodiscard]] double real_time_factor() const noexcept;
  [[nodiscard]] double steps_per_second() const noexcept;

 private:
  struct Sample {
    double wall = 0.0;
    double simulated = 0.0;
    std::int64_t steps = 0;
  };

  double window_;
  std::deque<Sample> samples_;
};

}  // namespace splash::sim
