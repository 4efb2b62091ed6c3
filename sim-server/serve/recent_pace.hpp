// SPDX-License-Identifier: MIT
// The speed of the simulation over the last second, in contrast to its mean since the start.
#pragma once

#include <cstdint>
#include <deque>

namespace splash::sim {

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
