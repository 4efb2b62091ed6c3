// SPDX-License-Identifier: MIT
#include "protocol/clock_reading.hpp"

#include <limits>

namespace splash::protocol {

ClockReading read_clocks(Clock monotonic, Clock unix_time) {
  constexpr int kReadings = 4;
  ClockReading best;
  double shortest = std::numeric_limits<double>::infinity();
  for (int k = 0; k < kReadings; ++k) {
    const double before = monotonic();
    const double between = unix_time();
    const double took = monotonic() - before;
    if (took >= shortest) continue;
    shortest = took;
    best = {before + 0.5 * took, between};
  }
  return best;
}

}  // namespace splash::protocol
