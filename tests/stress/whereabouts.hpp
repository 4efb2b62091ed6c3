// SPDX-License-Identifier: MIT
// Where the particles are: all of them in the tank, none in a body, as high in the mean as they
// were.
#pragma once

#include "sim-server/simulation/simulation.hpp"

namespace splash::stress {

/// Every particle is there once, has finite numbers and is not behind a wall of the tank.
[[nodiscard]] bool nobody_lost(sim::Simulation& simulation);

/// How deep below a body's surface the deepest particle is, with the bodies where they are now [m];
/// 0: none is in any.
[[nodiscard]] double deepest_inside(sim::Simulation& simulation);

/// Of all particles [m].
[[nodiscard]] double mean_height(sim::Simulation& simulation);

}  // namespace splash::stress
