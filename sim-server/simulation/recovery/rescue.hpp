// SPDX-License-Identifier: MIT
// What is done after a mishap, once the water is back in its last sound state: the place is found,
// and the water around it stopped.
#pragma once

#include "sim-server/bodies/body_steps.hpp"
#include "sim-server/fluid/fluid.hpp"
#include "sim-server/simulation/recovery/mishap.hpp"

namespace splash::sim {

/// Where that happened, and the body nearest to it: names in `mishap`, whose diagnosis and time are
/// known, the rest. `sound_at`: time of the water's state [s].
void locate(Mishap& mishap, Fluid& fluid, const Bodies& bodies, const Scene& scene,
            double sound_at);

/// Stops the water and the free bodies around the mishap, or all of it where many particles were
/// wrong; farther around when `times` frames in a row were given up. Notes how far.
void calm(Mishap& mishap, Fluid& fluid, Bodies& bodies, int times, double sound_at);

}  // namespace splash::sim
