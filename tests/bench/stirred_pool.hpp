// SPDX-License-Identifier: MIT
// The paper's pool, settled, with a stirrer in one corner that keeps about a tenth of its water
// awake: what sleep saves in steady state.
#pragma once

#include <map>
#include <string>

#include "sim-server/device/device.hpp"
#include "tests/bench/opencl_ledger.hpp"

namespace splash::bench {

struct StirredPool {
  int particles = 0;
  double awake = 0.0;        ///< share of the particles that moved, mean over the frames [1]
  double asleep_step = 0.0;  ///< processor time of a step with sleep [s]
  double awake_step = 0.0;   ///< and without [s]
  /// By kernel, per step [s], with sleep and without.
  std::map<std::string, std::pair<double, double>> stages;
};

/// Both run the same seconds of the same scene by turns, after the settling.
[[nodiscard]] StirredPool measure_stirred_pool(sim::Device& device, int particles);
/// Where the time goes.
void print_stages(const StirredPool& pool);

}  // namespace splash::bench
