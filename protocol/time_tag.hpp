// SPDX-License-Identifier: MIT
// OSC time tags (NTP: 32.32 fixed-point seconds since 1900) and the seconds they stand for.
#pragma once

#include <cstdint>

namespace splash::protocol {

struct TimeTag {
  std::uint64_t value = 1;
  bool operator==(const TimeTag&) const = default;
};

/// The tag that means "at once".
inline constexpr TimeTag kImmediately{1};

/// Seconds between 1900-01-01 (NTP) and 1970-01-01 (Unix).
inline constexpr double kNtpUnixOffset = 2208988800.0;

/// Unix time [s] to a tag; resolution about 0.25 ns in the tag, 0.2 us in a double of today.
[[nodiscard]] TimeTag to_time_tag(double unix_seconds) noexcept;
/// Tag to Unix time [s].
[[nodiscard]] double to_unix_seconds(TimeTag tag) noexcept;
/// Seconds since a score's start [s], as event logs and scsynth's score files count them.
[[nodiscard]] TimeTag to_score_tag(double seconds) noexcept;
[[nodiscard]] double to_score_seconds(TimeTag tag) noexcept;

/// System clock now, Unix time [s].
[[nodiscard]] double unix_now() noexcept;
/// Monotonic clock now [s].
[[nodiscard]] double monotonic_now() noexcept;

}  // namespace splash::protocol
