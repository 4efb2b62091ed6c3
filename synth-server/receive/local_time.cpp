// SPDX-License-Identifier: MIT
#include "synth-server/receive/local_time.hpp"

#include <cmath>
#include <cstdint>
#include <utility>

namespace splash::synth {
namespace {

/// NTP slews the system clock by less than this between two refreshes; more is a step [s].
constexpr double kStep = 1e-3;
constexpr double kTagsPerSecond = 4294967296.0;

}  // namespace

LocalTime::LocalTime(protocol::Clock unix_clock, protocol::Clock monotonic_clock)
    : unix_clock_(std::move(unix_clock)),
      monotonic_clock_(std::move(monotonic_clock)),
      reference_(protocol::read_clocks(monotonic_clock_, unix_clock_)),
      reference_tag_(protocol::to_time_tag(reference_.unix_time)) {}

bool LocalTime::refresh() {
  const protocol::ClockReading now = protocol::read_clocks(monotonic_clock_, unix_clock_);
  const double moved =
      (now.unix_time - now.monotonic) - (reference_.unix_time - reference_.monotonic);
  if (std::abs(moved) < kStep) return false;
  reference_ = now;
  reference_tag_ = protocol::to_time_tag(now.unix_time);
  return true;
}

double LocalTime::monotonic_of(protocol::TimeTag tag) const noexcept {
  // The difference wraps as two's complement, so it is exact and signed within 68 years.
  const auto ticks = static_cast<std::int64_t>(tag.value - reference_tag_.value);
  return reference_.monotonic + static_cast<double>(ticks) / kTagsPerSecond;
}

double LocalTime::unix_of(double monotonic) const noexcept {
  return reference_.unix_time + (monotonic - reference_.monotonic);
}

}  // namespace splash::synth
