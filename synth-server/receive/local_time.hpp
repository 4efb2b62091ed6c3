// SPDX-License-Identifier: MIT
// Time tags on this host's monotonic clock. A reference pair of readings is kept, so that two tags
// differ here by exactly what they differ on the wire; it is renewed when someone sets the clock.
#pragma once

#include "protocol/time_tag.hpp"

namespace splash::synth {

class LocalTime {
 public:
  explicit LocalTime(protocol::Clock unix_clock = protocol::unix_now,
                     protocol::Clock monotonic_clock = protocol::monotonic_now);

  /// Monotonic moment of a time tag [s].
  [[nodiscard]] double monotonic_of(protocol::TimeTag tag) const noexcept;
  /// System time at a monotonic moment [s, Unix].
  [[nodiscard]] double unix_of(double monotonic) const noexcept;
  /// Reads both clocks again; true when the system clock had been set and a new pair was taken.
  bool refresh();

 private:
  protocol::Clock unix_clock_;
  protocol::Clock monotonic_clock_;
  protocol::ClockReading reference_;
  protocol::TimeTag reference_tag_;
};

}  // namespace splash::synth
