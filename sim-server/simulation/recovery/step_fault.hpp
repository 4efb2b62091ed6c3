// SPDX-License-Identifier: MIT
// Describes a fault of a frame and how it was recovered, for the log.
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

/// Returns what was wrong with which particle or body, and where.
[[nodiscard]] std::string describe_fault(const StepFault& step_fault);
/// Returns a sentence: time, place, fault, likely cause and recovery.
[[nodiscard]] std::string describe(const StepFault& step_fault);

}  // namespace splash::sim
