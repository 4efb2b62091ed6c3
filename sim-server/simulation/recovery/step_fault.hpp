// SPDX-License-Identifier: MIT
// A frame that went wrong, and what became of it, for people.
#pragma once

#include <string>

#include "sim-server/fluid/health/health.hpp"
#include "sim-server/scene/scene.hpp"
#include "sim-server/simulation/recovery/recovery.hpp"

namespace splash::sim {

struct StepFault {
  Diagnosis what;
  std::int64_t step = 0;            ///< of the run
  double seconds = 0.0;             ///< simulated, at the beginning of that step [s]
  Vector3 place = {0.0, 0.0, 0.0};  ///< of the particle when it last was sound [m]
  std::string body;                 ///< the nearest to that place; empty: none
  double distance = 0.0;            ///< of its centre [m]
  Remedy remedy = Remedy::retry;    ///< that ended it
  int tries = 0;                    ///< that failed
  double calmed = 0.0;              ///< radius within which the water was stopped [m]
};

/// What was wrong with what, and where.
[[nodiscard]] std::string describe_fault(const StepFault& step_fault);
/// A sentence: when and where, what was wrong, what may have caused it and what was done.
[[nodiscard]] std::string describe(const StepFault& step_fault);

}  // namespace splash::sim
