// SPDX-License-Identifier: MIT
// What the validation found, as Markdown for people, CSV for programs and pictures.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "tests/validation/cases.hpp"

namespace splash::validation {

/// One case at one resolution, by one solver.
struct Result {
  const Case* item = nullptr;
  sim::PressureKind solver = sim::PressureKind::weakly_compressible;
  double spacing = 0.0;             ///< [m]
  int particles = 0;                ///< of the largest scene of a sweep
  double simulated = 0.0;           ///< all scenes of a sweep together [s]
  std::int64_t steps = 0;           ///< of all scenes together
  Effort all;                       ///< with set-up, settling and gauges
  Effort steps_alone;               ///< without them
  sim::SolveWork work;              ///< of the last scene
  double mean_density_error = 0.0;  ///< of the last scene, over its frames [1]
  Outcome outcome;
};

/// Runs one case at one resolution. `progress` gets the share done [0, 1].
[[nodiscard]] Result run_case(sim::Device& device, const Case& item, const Setting& setting,
                              const std::filesystem::path& series_folder,
                              const std::function<void(double)>& progress = {});

/// What each case gave, at all resolutions and by all solvers, and its run time: Markdown.
[[nodiscard]] std::string tables(const std::vector<Result>& results);

/// Writes report.md, figures.csv and a picture per case into `folder`. Throws std::runtime_error.
void write_report(const std::filesystem::path& folder, const std::string& device,
                  const std::vector<Result>& results);

}  // namespace splash::validation
