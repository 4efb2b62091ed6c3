// SPDX-License-Identifier: MIT
// What people are told of a scene's water before time begins.
#pragma once

#include <string>
#include "sim-server/simulation/simulation.hpp"

namespace splash::sim {

// Describes the water of a scene that found no place, for the terminal.

/// Returns one line on the blocks that have more or less water than the scene specifies, with the
/// bodies where they are when time begins: litres and level, specified and present. Empty when all
/// are right within 0.2 %. To be called before the first frame.
[[nodiscard]] std::string missing_water(const Simulation& simulation);

// Describes the water of a scene that nothing supports, for the terminal.

/// Returns one line on the blocks of water that flow or fall from where the scene puts them, and
/// how to change that. Empty if there are none, the scene wants no settling, or nothing has weight.
/// To be called before the first frame.
[[nodiscard]] std::string unsupported_water(Simulation& simulation);

}  // namespace splash::sim
