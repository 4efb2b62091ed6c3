// SPDX-License-Identifier: MIT
// Where the water's particles are before anything moves.
#pragma once

#include <span>
#include <vector>

#include "sim-server/scene/scene.hpp"

namespace splash::sim {

/// Whether a place of the block's box is inside its form.
[[nodiscard]] bool is_filled(const WaterBlock& block, const Vector3& place);

/// Whether a body at one of `poses` displaces a particle there: it is nearer than half a `spacing`
/// to its surface, or inside [m].
[[nodiscard]] bool is_displaced(const Scene& scene, std::span<const Keyframe> poses,
                                const Vector3& place, double spacing);

/// Centres of the particles: a lattice per block of water that fills its box exactly, half a
/// spacing from its sides and above the slope, without those outside a round form and those that a
/// body displaces. `poses` are the
/// bodies' at the start (their times are ignored), one each; without them bodies are where
/// `rest` says. The order is fixed: x fastest, then y, then z.
[[nodiscard]] std::vector<Vector3> initial_particles(const Scene& scene);
[[nodiscard]] std::vector<Vector3> initial_particles(const Scene& scene,
                                                     std::span<const Keyframe> poses);

}  // namespace splash::sim
