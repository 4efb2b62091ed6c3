// SPDX-License-Identifier: MIT
// The validation cases: which scenes, how fine, how long, and what is read from the gauges.
#pragma once

#include <limits>
#include <string>
#include <vector>

#include "tests/validation/run.hpp"

namespace splash::validation {

/// One number of a case and the range that is wanted of it.
struct Figure {
  std::string name;
  double value = 0.0;
  std::string unit;
  double lowest = -std::numeric_limits<double>::infinity();
  double highest = std::numeric_limits<double>::infinity();

  [[nodiscard]] bool has_gate() const;
  [[nodiscard]] bool passes() const { return value >= lowest && value <= highest; }
};

/// A line or points for the case's picture.
struct Curve {
  std::string title;
  Column x;
  Column y;
};

struct Outcome {
  std::vector<Figure> figures;  ///< the same ones at every resolution, the case's error first
  std::vector<Curve> curves;
};

struct Case {
  std::string name;
  std::string title;                ///< one line for people
  std::vector<std::string> scenes;  ///< of tests/validation/scenes; more than one: a sweep
  double seconds = 0.0;             ///< simulated, at most
  std::vector<double> spacings;     ///< [m], coarse to fine
  double size = 1.0;                ///< what is resolved [m]: size / spacing is the resolution
  std::string size_name;            ///< "H", "D", ...
  /// Takes one run per scene.
  Outcome (*evaluate)(const std::vector<Run>& runs) = nullptr;
  /// What the reference is in the picture.
  std::vector<Curve> (*reference)() = nullptr;
  std::string x_label;
  std::string y_label;
};

[[nodiscard]] const std::vector<Case>& all_cases();
/// Throws std::out_of_range that lists the names.
[[nodiscard]] const Case& case_named(const std::string& name);

// One file each.
[[nodiscard]] Case hydrostatic();
[[nodiscard]] Case standing_wave();
[[nodiscard]] Case elliptical_drop();
[[nodiscard]] Case oscillating_drop();
[[nodiscard]] Case vortex();
[[nodiscard]] Case dam_martin_moyce();
[[nodiscard]] Case dam_koshizuka_oka();
[[nodiscard]] Case spheric2();
[[nodiscard]] Case slap();
[[nodiscard]] Case pinch_off();
[[nodiscard]] Case closed_box();
[[nodiscard]] Case pressure_noise();
[[nodiscard]] Case floating();
[[nodiscard]] Case sinking_cube();
[[nodiscard]] Case sinking_ball();

}  // namespace splash::validation
