// SPDX-License-Identifier: MIT
// Describes the water of a scene that found no place, for the terminal.
#pragma once

#include <string>

#include "sim-server/simulation/simulation.hpp"

namespace splash::sim {

/// Returns one line on the blocks that have more or less water than the scene specifies, with the
/// bodies where they are when time begins: litres and level, specified and present. Empty when all
/// are right within 0.2 %. To be called before the first frame.
[[nodiscard]] std::string missing_water(const Simulation& simulation);

}  // namespace splash::sim
