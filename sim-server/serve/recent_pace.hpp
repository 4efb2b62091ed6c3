// SPDX-License-Identifier: MIT
// How fast the simulation has been of late, not on average since it began.
#pragma once

#include <cstdint>
#include <deque>

namespace splash::sim {

class RecentPace {
 public:
  /// Over the last `window` seconds of our clock.
  explicit RecentPace(double window = 1.0) noexcept : window_(window) {}

  /// At the end of each frame: our clock, simulated time [s] and the steps done so far.
  void note(double wall, double simulated, std::int64_t steps);

  /// Simulated time in wall time [1]; 0 before the second frame.
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
