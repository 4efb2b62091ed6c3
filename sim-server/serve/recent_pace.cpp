// SPDX-License-Identifier: MIT
#include "sim-server/serve/recent_pace.hpp"

namespace splash::sim {

void RecentPace::note(double wall, double simulated, std::int64_t steps) {
  samples_.push_back({wall, simulated, steps});
  // The newest of those that are old enough stays: the span is the window and a frame at most.
  while (samples_.size() > 2 && wall - samples_[1].wall >= window_) samples_.pop_front();
}

double RecentPace::real_time_factor() const noexcept {
  if (samples_.size() < 2) return 0.0;
  const double wall = samples_.back().wall - samples_.front().wall;
  return wall > 0.0 ? (samples_.back().simulated - samples_.front().simulated) / wall : 0.0;
}

double RecentPace::steps_per_second() const noexcept {
  if (samples_.size() < 2) return 0.0;
  const double wall = samples_.back().wall - samples_.front().wall;
  const auto steps = static_cast<double>(samples_.back().steps - samples_.front().steps);
  return wall > 0.0 ? steps / wall : 0.0;
}

}  // namespace splash::sim
