// SPDX-License-Identifier: MIT
// One scene at one resolution, run through the whole simulation, all its gauges read.
#pragma once

#include <functional>
#include <string>

#include "sim-server/device/device.hpp"
#include "sim-server/scene/scene.hpp"
#include "tests/validation/series.hpp"

namespace splash::validation {

/// What a case is run with.
struct Setting {
  double spacing = 0.0;  ///< of particles [m]
  sim::SmoothingKind smoothing = sim::SmoothingKind::narrow;
  sim::PressureKind solver = sim::PressureKind::weakly_compressible;
};

struct Run {
  sim::Scene scene;
  Series gauges;  ///< the scene's, by their columns' names
  int particles = 0;
  std::int64_t steps = 0;
  double simulated = 0.0;  ///< without settling [s]
  double wall = 0.0;       ///< with settling and gauges [s]
  double processor = 0.0;  ///< the same, user time of all cores [s]
};

/// Reads tests/validation/scenes/`name`.yaml.
[[nodiscard]] sim::Scene scene_named(const std::string& name);
/// Reads tests/validation/reference/`name`.csv.
[[nodiscard]] Series reference_named(const std::string& name);

/// Runs for `seconds`; `progress` gets the share done [0, 1].
[[nodiscard]] Run run_scene(sim::Device& device, const std::string& name, const Setting& setting,
                            double seconds, const std::function<void(double)>& progress = {});

}  // namespace splash::validation
