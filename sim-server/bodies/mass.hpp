// SPDX-License-Identifier: MIT
// The free bodies of a scene: their mass and how hard they are to turn.
#pragma once

#include <vector>

#include "sim-server/fluid/params/fluid_params.h"
#include "sim-server/scene/scene.hpp"

namespace splash::sim {

/// Of a free body [kg].
[[nodiscard]] double mass_of(const BodySettings& body);

/// The free ones of a scene's bodies, for the device; also those on springs.
[[nodiscard]] std::vector<FreeBody> free_bodies(const std::vector<BodySettings>& bodies);
/// Those that go where poses are, then those that poses can take from a motion of their own: their
/// push is felt, their mass is not known and left out. As many as may be free at most.
[[nodiscard]] std::vector<FreeBody> felt_bodies(const std::vector<BodySettings>& bodies);

}  // namespace splash::sim
