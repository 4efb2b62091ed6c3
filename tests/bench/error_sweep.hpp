// SPDX-License-Identifier: MIT
// Run time against error: validation cases run with every quality setting at every resolution.
#pragma once

#include <string>
#include <vector>

#include "tests/validation/report.hpp"

namespace splash::bench {

/// A way to compute the water: what a scene's `fluid` table chooses.
struct Quality {
  sim::PressureKind solver = sim::PressureKind::weakly_compressible;
  double time_step_factor = 1.0;  ///< of the safe time step [1]
  sim::KernelKind kernels = sim::KernelKind::vector;

  [[nodiscard]] std::string name() const;
  friend bool operator==(const Quality&, const Quality&) = default;
};

/// A case that is cheap enough, and the one number of it that is its error.
struct SweepCase {
  std::string name;      ///< of tests/validation
  std::string figure;    ///< its size is the error
  double seconds = 0.0;  ///< simulated; 0: as long as the case says
};

struct SweepPoint {
  const SweepCase* item = nullptr;
  Quality quality;
  validation::Result result;

  [[nodiscard]] double error() const;       ///< in figure's unit, not negative
  [[nodiscard]] double iterations() const;  ///< of a solve, on average
  /// Seconds of computing per simulated second, set-up, settling and gauges left out [1]: of the
  /// clock, or of processors, shared among `cores`.
  [[nodiscard]] double wall_cost() const;
  [[nodiscard]] double processor_cost(unsigned cores) const;
};

struct SweepPlan {
  std::vector<const SweepCase*> cases;
  std::vector<Quality> qualities;
  std::size_t resolutions = 2;  ///< coarse ones first
};

[[nodiscard]] const std::vector<SweepCase>& sweep_cases();
/// All solvers, and of the default one half the time step and the reference kernels.
[[nodiscard]] std::vector<Quality> quick_qualities();
/// Solver x time-step factor 0.5, 1 and 1.25, and each solver with the reference kernels.
[[nodiscard]] std::vector<Quality> all_qualities();

/// Runs the plan with progress on the terminal; `done` is called with all points so far after each.
/// Nothing sleeps: a column that does costs nothing, and says nothing about its solver. Nobody
/// looks for bubbles: with a thousand frames a second that costs more than the water.
[[nodiscard]] std::vector<SweepPoint> sweep(
    const SweepPlan& plan, int device,
    const std::function<void(const std::vector<SweepPoint>&)>& done);

}  // namespace splash::bench
