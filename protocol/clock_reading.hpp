// SPDX-License-Identifier: MIT
// The monotonic and the system clock at one moment. A thread may be preempted between reading the
// one and the other; of several readings the one that took the shortest tells best.
#pragma once

#include "protocol/time_tag.hpp"

namespace splash::protocol {

struct ClockReading {
  double monotonic = 0.0;  ///< [s]
  double unix_time = 0.0;  ///< at the same moment [s]
};

using Clock = double (*)();

[[nodiscard]] ClockReading read_clocks(Clock monotonic = monotonic_now, Clock unix_time = unix_now);

}  // namespace splash::protocol
