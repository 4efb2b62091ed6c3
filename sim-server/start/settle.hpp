// SPDX-License-Identifier: MIT
// Lets water come to rest before anything happens to it.
#pragma once

#include <functional>
#include <vector>

#include "sim-server/fluid/fluid.hpp"
#include "sim-server/start/pinned_particles.hpp"

namespace splash::sim {

/// Is told now and then which part of a long task is done [1].
using Progress = std::function<void(double share)>;

/// The same bodies, not moving.
[[nodiscard]] std::vector<BodyStep> at_rest(std::vector<BodyStep> bodies);

/// Runs `fluid` in steps of `dt` [s] with its bodies where `bodies`, at rest, says: for `seconds`
/// first freely, so that the lattice finds a better packing, then stopping all motion again and
/// again, so that the column ceases to breathe. Then it is left alone, and stopped once more, until
/// nothing gets faster than a twentieth of its longest wave within half a second; four times
/// `seconds` in all at most. `piston`: offset of the wave maker [m]. The `pinned` particles
/// stay where they are; if those are all, nothing is done.
void settle(Fluid& fluid, const std::vector<BodyStep>& bodies, double piston, double seconds,
            double dt, const Progress& tell = {}, PinnedParticles* pinned = nullptr);

}  // namespace splash::sim
