// SPDX-License-Identifier: MIT
// Tells whoever starts a scene which of its water did not come to rest, as nothing holds it.
#pragma once

#include <string>

#include "sim-server/simulation/simulation.hpp"

namespace splash::sim {

/// One line on the water that begins as the scene says: which blocks, and what to do to have it
/// otherwise. Empty if there is none, or the scene wants none to settle, or has no weight. Before
/// the first frame.
[[nodiscard]] std::string unsupported_water(Simulation& simulation);

}  // namespace splash::sim
