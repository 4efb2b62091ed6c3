// SPDX-License-Identifier: MIT
// The sums by hand, for one instruction set each.
#pragma once

#include "tests/bench/fluid_yardstick.hpp"

namespace splash::bench {

/// First particles of the groups that share a list of neighbours.
struct Starts {
  const int* first = nullptr;
  int count = 0;
};

using Sums = void (*)(const Particles& particles, const Starts& starts, int threads, float* sums);

struct YardstickLoops {
  Sums density = nullptr;
  Sums acceleration = nullptr;
  int group = 0;  ///< particles that share a list of neighbours
};

}  // namespace splash::bench
