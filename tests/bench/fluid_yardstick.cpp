// SPDX-License-Identifier: MIT
#include "tests/bench/fluid_yardstick.hpp"

#include <vector>

namespace splash::bench {

YardstickLoops yardstick_portable();
#ifdef __x86_64__
YardstickLoops yardstick_avx2();
YardstickLoops yardstick_avx512();
#endif

namespace {

/// The best that this processor can.
YardstickLoops loops() {
#ifdef __x86_64__
  if (__builtin_cpu_supports("avx512f") != 0 && __builtin_cpu_supports("avx512dq") != 0 &&
      __builtin_cpu_supports("avx512vl") != 0) {
    return yardstick_avx512();
  }
  if (__builtin_cpu_supports("avx2") != 0 && __builtin_cpu_supports("fma") != 0) {
    return yardstick_avx2();
  }
#endif
  return yardstick_portable();
}

/// First particles of all groups: row by row, so that none straddles two.
std::vector<int> group_starts(const Particles& p, int group) {
  std::vector<int> starts;
  const auto slices = static_cast<std::size_t>(SPLASH_SLICES * p.params.cells_x);
  for (std::size_t row = 0; (row + 1) * slices < p.cell_start.size(); ++row) {
    const int end = p.cell_start[(row + 1) * slices];
    for (int first = p.cell_start[row * slices]; first < end; first += group) {
      starts.push_back(first);
    }
  }
  return starts;
}

void run(Sums sums, int group, const Particles& p, int threads, float* found) {
  const std::vector<int> starts = group_starts(p, group);
  sums(p, {starts.data(), static_cast<int>(starts.size())}, threads, found);
}

}  // namespace

void density_by_hand(const Particles& particles, int threads, std::vector<float>& density) {
  run(loops().density, loops().group, particles, threads, density.data());
}

void acceleration_by_hand(const Particles& particles, int threads,
                          std::vector<float>& acceleration) {
  run(loops().acceleration, loops().group, particles, threads, acceleration.data());
}

}  // namespace splash::bench
