// SPDX-License-Identifier: MIT
// What is done after a fault, once the water is back in its last sound state: the place is found,
// and the water around it stopped.
#pragma once

#include "sim-server/bodies/body_steps.hpp"
#include "sim-server/fluid/fluid.hpp"
#include "sim-server/simulation/recovery/step_fault.hpp"

namespace splash::sim {

/// Where that happened, and the body nearest to it: names in `step_fault`, whose diagnosis and time
/// are known, the rest. `sound_at`: time of the water's state [s].
void locate(StepFault& step_fault, Fluid& fluid, const Bodies& bodies, const Scene& scene,
            double sound_at);

/// Stops the water and the free bodies around the fault, or all of it where many particles were
/// wrong; farther around when `times` frames in a row were given up. Notes how far.
void calm(StepFault& step_fault, Fluid& fluid, Bodies& bodies, int times, double sound_at);

}  // namespace splash::sim
