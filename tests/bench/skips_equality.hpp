// SPDX-License-Identifier: MIT
// A scene with each skip on or off: what its gauges and its events say, and what it took.
#pragma once

#include <string>
#include <vector>

#include "sim-server/simulation/simulation.hpp"
#include "tests/validation/series.hpp"

namespace splash::bench {

/// A scene to be held against itself.
struct SkipScene {
  std::string name;
  sim::Scene scene;  ///< with gauges
  double seconds = 0.0;
};

/// A way to run it.
struct SkipVariant {
  std::string name;
  sim::SkipSettings skip;
  double time_step_factor = 1.0;
};

struct SkipRun {
  validation::Series gauges;
  sim::Detections found;
  sim::RunTotals totals;
  double processor = 0.0;  ///< of the frames, user time of all cores [s]
};

/// How far two runs are apart; heights and pressures by the gauges' names.
struct SkipDifference {
  double height_most = 0.0;    ///< [m]
  double height_rms = 0.0;     ///< [m]
  double pressure_rms = 0.0;   ///< [Pa]
  double pressure_size = 0.0;  ///< rms of the pressures themselves [Pa]
  bool same_events = false;    ///< each of them, bit by bit
};

/// The plunge as shipped, with gauges; SPHERIC 2 with particles 4 cm apart.
[[nodiscard]] std::vector<SkipScene> skip_scenes();
/// All on; each off; all off; and all off with steps shorter by a thousandth, which is the noise:
/// what two runs of the same water differ by.
[[nodiscard]] std::vector<SkipVariant> skip_variants();

[[nodiscard]] SkipRun run_with(sim::Device& device, const SkipScene& scene,
                               const SkipVariant& variant);
[[nodiscard]] SkipDifference difference(const SkipRun& a, const SkipRun& b);

}  // namespace splash::bench
