// SPDX-License-Identifier: MIT
// The water's particles as viewers and files get them.
#pragma once

#include "sim-server/fluid/fluid.hpp"
#include "sim-server/show/state_frame.hpp"

namespace splash::sim {

/// Reads the water back from the device, between two frames; waits.
void read_water(Fluid& fluid, ShownWater& water);

}  // namespace splash::sim
