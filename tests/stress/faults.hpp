// SPDX-License-Identifier: MIT
// Test S1: still water, faults at random moments and places, and what became of each. Nothing ever
// moves there, so every event that is told comes of a fault.
#pragma once

#include <string>
#include <vector>

#include "sim-server/scene/solver_choice.hpp"
#include "tests/stress/injection.hpp"
#include "tests/support/detections.hpp"

namespace splash::stress {

using tests::kBothSolvers;

/// A little still water with a body above it, in steps of `factor` of the largest.
[[nodiscard]] sim::Scene still_scene(sim::PressureKind solver, double factor);

struct Outcome {
  std::string fault;
  int place = 0;         ///< particle's index
  bool seen = false;     ///< in the very step of the injection
  std::size_t told = 0;  ///< events within a second after
  double ill_for = 0.0;  ///< simulated, until frames were sound again [s]
  bool finite = true;    ///< all numbers of the state, ever after
  std::string sentence;  ///< that people read
  [[nodiscard]] bool passes() const {
    return seen && told == 0 && ill_for <= 1.0 && finite && !sentence.empty();
  }
};

/// Runs `simulation` through all of `faults`, each at `places` random places and moments.
[[nodiscard]] std::vector<Outcome> run_faults(sim::Simulation& simulation,
                                              const std::vector<Injection>& faults, int places,
                                              unsigned seed);

}  // namespace splash::stress
