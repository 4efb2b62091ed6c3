// SPDX-License-Identifier: MIT
// Determines which water is supported where a scene puts it. Water at rest is level: its free
// surface is an equipotential of gravity and pull (Lamb, Hydrodynamics, article 5). So a connected
// body of water is supported if no air that it could flow into lies more than two spacings below
// its highest place. A dam without a gate, a drop in the air and a column on a pool are not
// supported.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "sim-server/scene/scene.hpp"

namespace splash::sim {

/// supported: the water stays; flowing: it flows off, but something is beneath it; free_falling:
/// nothing is beneath it.
enum class SupportState : std::uint8_t { supported, flowing, free_falling };

/// Returns the state of each of `particles` [m]; all particles of one body of water have the same.
/// `poses`: one for each body; their times are ignored. Without gravity and pull all water is free
/// falling.
[[nodiscard]] std::vector<SupportState> support_states(const Scene& scene,
                                                       std::span<const Keyframe> poses,
                                                       const std::vector<Vector3>& particles);

/// Whether something holds all of the scene's water, with the bodies in their poses of rest.
[[nodiscard]] bool is_all_supported(const Scene& scene);

}  // namespace splash::sim
