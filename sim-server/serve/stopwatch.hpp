// SPDX-License-Identifier: MIT
// What something costs, by the clock on the wall and in time of all processors.
#pragma once

#include <ctime>

#include "protocol/time_tag.hpp"

namespace splash::sim {

struct Cost {
  double wall = 0.0;       ///< [s]
  double processor = 0.0;  ///< of all threads of the program [s]
};

class Stopwatch {
 public:
  /// Since its construction.
  [[nodiscard]] Cost passed() const noexcept {
    const Cost now = read();
    return {now.wall - start_.wall, now.processor - start_.processor};
  }

 private:
  static Cost read() noexcept {
    timespec used{};
    (void)clock_gettime(CLOCK_PROCESS_CPUTIME_ID, &used);
    return {protocol::monotonic_now(),
            static_cast<double>(used.tv_sec) + 1e-9 * static_cast<double>(used.tv_nsec)};
  }

  Cost start_ = read();
};

}  // namespace splash::sim
