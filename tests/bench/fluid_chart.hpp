// SPDX-License-Identifier: MIT
// Run time against error as a table (CSV), as Markdown and as a picture (PNG).
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "tests/bench/fluid_sweep.hpp"

namespace splash::bench {

/// Which seconds the picture is drawn over.
enum class Clock {
  wall,      ///< those that passed: on a machine with nothing else to do
  processor  ///< those of processors, as if shared evenly among all cores
};

struct ChartSettings {
  Clock clock = Clock::wall;
  unsigned cores = 1;  ///< of the device
  std::string device;  ///< its name, for the title
};

/// Writes error.csv, error.md and error.png into `folder`. Throws std::runtime_error.
void write_error_chart(const std::filesystem::path& folder, const ChartSettings& settings,
                       const std::vector<SweepPoint>& points);

}  // namespace splash::bench
