// SPDX-License-Identifier: MIT
// One scene at one resolution, run through the whole simulation, all its gauges read.
#pragma once

#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "sim-server/device/device.hpp"
#include "sim-server/scene/scene.hpp"
#include "sim-server/simulation/simulation.hpp"
#include "tests/validation/series.hpp"

namespace splash::validation {

/// What a case is run with.
struct Setting {
  double spacing = 0.0;  ///< of particles [m]
  sim::PressureKind solver = sim::PressureKind::weakly_compressible;
  double time_step_factor = 1.0;                         ///< of the safe time step [1]
  std::optional<sim::SkipSettings> skip = std::nullopt;  ///< instead of the scene's
  bool detects = true;                                   ///< looks for bubbles and cavities
  double most_frames = 1.0e6;  ///< per second, where the scene has more [1/s]
};

/// What it took to compute something [s].
struct Effort {
  double wall = 0.0;
  double processor = 0.0;  ///< user time of all cores

  Effort& operator+=(const Effort& other) {
    wall += other.wall;
    processor += other.processor;
    return *this;
  }
};

struct Run {
  sim::Scene scene;
  Series gauges;  ///< the scene's, by their columns' names
  int particles = 0;
  std::vector<sim::Vector3> places;      ///< of the particles, at the end [m]
  std::vector<sim::Vector3> velocities;  ///< theirs [m/s]
  std::int64_t steps = 0;
  double simulated = 0.0;  ///< without settling [s]
  Effort all;              ///< with set-up, settling and gauges
  Effort steps_alone;      ///< without them
  sim::SolveWork work;     ///< iterations of a solver that iterates
  sim::RunTotals totals;
};

/// Reads tests/validation/scenes/`name`.yaml.
[[nodiscard]] sim::Scene scene_named(const std::string& name);
/// Reads tests/validation/reference/`name`.csv.
[[nodiscard]] Series reference_named(const std::string& name);

/// Runs for `seconds`; `progress` gets the share done [0, 1].
[[nodiscard]] Run run_scene(sim::Device& device, const std::string& name, const Setting& setting,
                            double seconds, const std::function<void(double)>& progress = {});

}  // namespace splash::validation
