// SPDX-License-Identifier: MIT
// A fault of a step: where it is, how the water around it is stopped, and how it is described.
#pragma once

#include <string>

#include "sim-server/bodies/body_steps.hpp"
#include "sim-server/fluid/fluid.hpp"
#include "sim-server/fluid/health/health.hpp"
#include "sim-server/scene/scene.hpp"
#include "sim-server/simulation/recovery/recovery.hpp"

namespace splash::sim {

// Describes a fault of a frame and how it was recovered, for the log.

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

// Locates a fault once the water is back in its last good state, and stops the water around it.

/// Adds the place of a fault and the nearest body to `step_fault`, whose diagnosis and time are
/// known. `sound_at`: time of the water's state [s].
void locate(StepFault& step_fault, Fluid& fluid, const Bodies& bodies, const Scene& scene,
            double sound_at);

/// Stops the water and the free bodies around the fault, or all of it when many particles were
/// wrong. The radius grows with `times`, the number of frames given up in a row; it is stored in
/// `step_fault`.
void calm(StepFault& step_fault, Fluid& fluid, Bodies& bodies, int times, double sound_at);

}  // namespace splash::sim
