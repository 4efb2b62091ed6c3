// SPDX-License-Identifier: MIT
// Whether something holds the water where a scene puts it. Water at rest is level: its free surface
// is an equipotential of gravity and pull (Lamb, Hydrodynamics, article 5). So a body of water is
// held if no air that it could flow into lies more than two spacings below its highest place; a
// dam without a gate, a drop in the air, a column on a pool are not.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "sim-server/scene/scene.hpp"

namespace splash::sim {

/// held: it stays; flows: off, but something is beneath it; hangs: it falls.
enum class SupportState : std::uint8_t { supported, flowing, free_falling };

/// Of each of `particles` [m], all those of one body of water alike. `poses` of the bodies, one
/// each; their times are ignored. Without gravity and pull all hangs.
[[nodiscard]] std::vector<SupportState> support_states(const Scene& scene,
                                                       std::span<const Keyframe> poses,
                                                       const std::vector<Vector3>& particles);

}  // namespace splash::sim
