// SPDX-License-Identifier: MIT
#include "sim-server/device/profile.hpp"

#include <algorithm>

namespace splash::sim {

Profile cpu_profile(unsigned cores, int lanes) {
  return {.lanes = lanes,
          .group = 4,
          .team = 1,
          .parts = 64,
          .judges = 64,
          .sort_chunks = static_cast<int>(std::clamp(cores, 1U, 64U))};
}

Profile gpu_profile() {
  return {};
}

}  // namespace splash::sim
