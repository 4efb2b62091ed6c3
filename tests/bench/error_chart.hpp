// SPDX-License-Identifier: MIT
// Run time against error as tables and as a picture, and what two other programs took for the same.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "tests/bench/error_sweep.hpp"
#include "tests/bench/tables.hpp"

namespace splash::bench {

/// The time on the picture's horizontal axis.
enum class Clock {
  wall,      ///< those that passed: on a machine with nothing else to do
  processor  ///< those of processors, as if shared evenly among all cores
};

struct ChartSettings {
  Clock clock = Clock::wall;
  unsigned cores = 1;  ///< of the device
  std::string device;  ///< its name, for the title
};

/// Writes error.csv and error.png into `folder`. Throws std::runtime_error.
void write_error_chart(const std::filesystem::path& folder, const ChartSettings& settings,
                       const std::vector<SweepPoint>& points);

/// What the picture and the table show: a paragraph.
[[nodiscard]] std::string explanation(const ChartSettings& settings);
/// A row for each case and resolution, with error and seconds of each quality.
[[nodiscard]] std::vector<Row> error_table(const ChartSettings& settings,
                                           const std::vector<SweepPoint>& points);

/// How the other programs were run: a paragraph, and the figures.
[[nodiscard]] std::string about_peers();
[[nodiscard]] std::vector<Row> peer_table();

}  // namespace splash::bench
