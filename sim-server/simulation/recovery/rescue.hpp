// SPDX-License-Identifier: MIT
// Locates a fault once the water is back in its last good state, and stops the water around it.
#pragma once

#include "sim-server/bodies/body_steps.hpp"
#include "sim-server/fluid/fluid.hpp"
#include "sim-server/simulation/recovery/step_fault.hpp"

namespace splash::sim {

/// Adds the place of a fault and the nearest body to `step_fault`, whose diagnosis and time are
/// known. `sound_at`: time of the water's state [s].
void locate(StepFault& step_fault, Fluid& fluid, const Bodies& bodies, const Scene& scene,
            double sound_at);

/// Stops the water and the free bodies around the fault, or all of it when many particles were
/// wrong. The radius grows with `times`, the number of frames given up in a row; it is stored in
/// `step_fault`.
void calm(StepFault& step_fault, Fluid& fluid, Bodies& bodies, int times, double sound_at);

}  // namespace splash::sim
