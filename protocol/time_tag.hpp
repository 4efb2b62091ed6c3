// SPDX-License-Identifier: MIT
// OSC time tags (NTP: 32.32 fixed-point seconds since 1900) to and from seconds, and the clocks.
#pragma once

#include <cstdint>
#include <functional>

namespace splash::protocol {

struct TimeTag {
  std::uint64_t value = 1;
  bool operator==(const TimeTag&) const = default;
};

/// The tag that means "at once".
inline constexpr TimeTag kImmediately{1};

/// Seconds between 1900-01-01 (NTP) and 1970-01-01 (Unix).
inline constexpr double kNtpUnixOffset = 2208988800.0;

/// Converts Unix time [s] to a tag, whose resolution is 0.25 ns; a double of today has 0.2 us.
[[nodiscard]] TimeTag to_time_tag(double unix_seconds) noexcept;
/// Converts a tag to Unix time [s].
[[nodiscard]] double to_unix_seconds(TimeTag tag) noexcept;
/// Converts seconds since a score's start [s], as event logs and scsynth's score files count them.
[[nodiscard]] TimeTag to_score_tag(double seconds) noexcept;
[[nodiscard]] double to_score_seconds(TimeTag tag) noexcept;

/// The system clock, Unix time [s].
[[nodiscard]] double unix_now() noexcept;
/// The monotonic clock [s].
[[nodiscard]] double monotonic_now() noexcept;

/// Tells the time [s]; tests bring their own.
using Clock = std::function<double()>;

/// The monotonic and the system clock at one moment.
struct ClockReading {
  double monotonic = 0.0;  ///< [s]
  double unix_time = 0.0;  ///< at the same moment [s]
};

/// A thread may be preempted between reading the one and the other; of several readings the one
/// that took the shortest tells best.
[[nodiscard]] ClockReading read_clocks(const Clock& monotonic = monotonic_now,
                                       const Clock& unix_time = unix_now);

}  // namespace splash::protocol
