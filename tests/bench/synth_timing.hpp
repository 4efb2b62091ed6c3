// SPDX-License-Identifier: MIT
// Processor time, not wall time: other programs may be running.
#pragma once

#include <ctime>
#include <vector>

#include "tests/support/median.hpp"

namespace splash::bench {

/// Of this process [s].
inline double cpu_seconds() {
  timespec now{};
  clock_gettime(CLOCK_PROCESS_CPUTIME_ID, &now);
  return static_cast<double>(now.tv_sec) + 1e-9 * static_cast<double>(now.tv_nsec);
}

using tests::median;

/// Median time of `runs` runs [s].
template <class Work>
double median_time(int runs, const Work& work) {
  std::vector<double> times;
  for (int run = 0; run < runs; ++run) {
    const double start = cpu_seconds();
    work();
    times.push_back(cpu_seconds() - start);
  }
  return median(times);
}

/// What was written to memory counts as read: else compilers leave the work out.
inline void consume(const void* memory) {
  asm volatile("" ::"r"(memory) : "memory");
}

}  // namespace splash::bench
