// SPDX-License-Identifier: MIT
// Waits with clock_nanosleep on the monotonic clock, at absolute times: nothing drifts.
#include "sim-server/serve/pacer.hpp"

#include <algorithm>
#include <cmath>
#include <ctime>
#include <limits>
#include <utility>

#include "protocol/time_tag.hpp"

namespace splash::sim {

namespace {

void sleep_until_monotonic(double seconds) {
  const double whole = std::floor(seconds);
  timespec until{};
  until.tv_sec = static_cast<time_t>(whole);
  until.tv_nsec = static_cast<long>((seconds - whole) * 1e9);
  // A signal ends the wait early: the caller looks at its stop flag between frames.
  (void)clock_nanosleep(CLOCK_MONOTONIC, TIMER_ABSTIME, &until, nullptr);
}

}  // namespace

PacerClock PacerClock::system() {
  return {protocol::monotonic_now, protocol::unix_now, sleep_until_monotonic};
}

Pacer::Pacer(PacerSettings settings, PacerClock clock)
    : settings_(settings), clock_(std::move(clock)) {
  start();
}

void Pacer::start(double seconds) {
  origin_ = clock_.monotonic() - seconds;
}

void Pacer::wait_until(double seconds) {
  if (!settings_.real_time) {
    start(seconds);  // simulated time is wherever the computation is
    return;
  }
  const double behind = clock_.monotonic() - (origin_ + seconds);
  if (behind <= 0.0) {
    clock_.sleep_until(origin_ + seconds);
    return;
  }
  if (behind > settings_.grace) ++counts_.behind;
  counts_.most_behind = std::max(counts_.most_behind, behind);
  if (behind > settings_.slip_limit) {
    origin_ += behind;
    counts_.slipped += behind;
  }
}

double Pacer::unix_origin() const {
  // The two clocks are read one after the other; when this thread is put aside in between, their
  // difference is wrong by milliseconds. Reading until the bracket is tight prevents that.
  constexpr double kTight = 20.0e-6;  // [s]
  double best = std::numeric_limits<double>::infinity();
  double origin = 0.0;
  for (int attempt = 0; attempt < 5 && best > kTight; ++attempt) {
    const double before = clock_.monotonic();
    const double unix_time = clock_.unix_time();
    const double after = clock_.monotonic();
    if (after - before >= best) continue;
    best = after - before;
    origin = unix_time - 0.5 * (before + after) + origin_;
  }
  return origin;
}

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
