// SPDX-License-Identifier: MIT
#include "synth-server/receive/local_time.hpp"

#include <cmath>
#include <cstdint>
#include <limits>
#include <utility>

namespace splash::synth {
namespace {

/// NTP slews the system clock by less than this between two refreshes; more is a step [s].
constexpr double kStep = 1e-3;
/// Readings of which the quickest is kept: the others were interrupted.
constexpr int kReadings = 5;
constexpr double kTagsPerSecond = 4294967296.0;

}  // namespace

LocalTime::LocalTime(Clock unix_clock, Clock monotonic_clock)
    : unix_clock_(std::move(unix_clock)),
      monotonic_clock_(std::move(monotonic_clock)),
      reference_(read()),
      reference_tag_(protocol::to_time_tag(reference_.unix_seconds)) {}

LocalTime::Pair LocalTime::read() const {
  Pair best;
  double shortest = std::numeric_limits<double>::infinity();
  for (int reading = 0; reading < kReadings; ++reading) {
    const double before = monotonic_clock_();
    const double system = unix_clock_();
    const double after = monotonic_clock_();
    if (after - before < shortest) {
      shortest = after - before;
      best = {system, 0.5 * (before + after)};
    }
  }
  return best;
}

bool LocalTime::refresh() {
  const Pair now = read();
  const double moved =
      (now.unix_seconds - now.monotonic) - (reference_.unix_seconds - reference_.monotonic);
  if (std::abs(moved) < kStep) return false;
  reference_ = now;
  reference_tag_ = protocol::to_time_tag(now.unix_seconds);
  return true;
}

double LocalTime::monotonic_of(protocol::TimeTag tag) const noexcept {
  // The difference wraps as two's complement, so it is exact and signed within 68 years.
  const auto ticks = static_cast<std::int64_t>(tag.value - reference_tag_.value);
  return reference_.monotonic + static_cast<double>(ticks) / kTagsPerSecond;
}

double LocalTime::unix_of(double monotonic) const noexcept {
  return reference_.unix_seconds + (monotonic - reference_.monotonic);
}

}  // namespace splash::synth
