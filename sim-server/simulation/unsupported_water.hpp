// SPDX-License-Identifier: MIT
// Describes the water of a scene that nothing supports, for the terminal.
#pragma once

#include <string>

#include "sim-server/simulation/simulation.hpp"

namespace splash::sim {

/// Returns one line on the blocks of water that flow or fall from where the scene puts them, and
/// how to change that. Empty if there are none, the scene wants no settling, or nothing has weight.
/// To be called before the first frame.
[[nodiscard]] std::string unsupported_water(Simulation& simulation);

}  // namespace splash::sim
