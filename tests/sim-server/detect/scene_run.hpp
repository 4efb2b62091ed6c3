// SPDX-License-Identifier: MIT
// A shipped scene, changed a little, run through the whole simulation faster than real time.
#pragma once

#include <string>
#include <vector>

#include "sim-server/simulation/simulation.hpp"
#include "tests/support/scene_text.hpp"

namespace splash::sim {

using tests::changed;
using tests::scene_text;

/// How high the water stands under the first body, and that body's centre, at the end of a frame.
struct Gauge {
  double time = 0.0;    ///< [s]
  double level = 0.0;   ///< [m]
  double height = 0.0;  ///< [m]
};

/// A run: all that was found, and what the water did.
struct SceneRun {
  Detections found;
  std::vector<Gauge> gauges;  ///< until the first impact was told and is over
  double time_step = 0.0;     ///< the longest [s]
  double frame = 0.0;         ///< the longest [s]
  RunTotals totals;
};
[[nodiscard]] SceneRun run_scene(const std::string& text, double seconds);

}  // namespace splash::sim
