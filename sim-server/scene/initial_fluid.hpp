// SPDX-License-Identifier: MIT
// Where the water's particles are before anything moves.
#pragma once

#include <span>
#include <vector>

#include "sim-server/scene/scene.hpp"

namespace splash::sim {

/// Centres of the particles: a lattice per block of water that fills its box exactly, half a
/// spacing from its sides and above the slope, without those outside a round form and those that a
/// body displaces. `poses` are the
/// bodies' at the start (their times are ignored), one each; without them bodies are where
/// `rest` says. The order is fixed: x fastest, then y, then z.
[[nodiscard]] std::vector<Vector3> initial_particles(const Scene& scene);
[[nodiscard]] std::vector<Vector3> initial_particles(const Scene& scene,
                                                     std::span<const Keyframe> poses);

}  // namespace splash::sim
