// SPDX-License-Identifier: MIT
// Tells whoever starts a scene which of its water found no place.
#pragma once

#include <string>

#include "sim-server/simulation/simulation.hpp"

namespace splash::sim {

/// One line on the blocks that have more or less water than the scene wants, with the bodies where
/// they are when time begins: litres and level, wanted and there. Empty where all are right to
/// 0.2 %. Before the first frame.
[[nodiscard]] std::string missing_water(const Simulation& simulation);

}  // namespace splash::sim
