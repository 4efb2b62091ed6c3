// SPDX-License-Identifier: MIT
// What viewers and files are shown of the water, as the device holds it.
#pragma once

#include "sim-server/fluid/fluid.hpp"
#include "sim-server/show/state_frame.hpp"

namespace splash::sim {

/// Reads the water back from the device, between two frames; waits.
void read_water(Fluid& fluid, ShownWater& water);

}  // namespace splash::sim
