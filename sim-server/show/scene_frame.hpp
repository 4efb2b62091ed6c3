// SPDX-License-Identifier: MIT
// What of a scene stays the same, as a viewer gets it (view-server/README.md, SPC1).
#pragma once

#include <string>

#include "protocol/frame.hpp"
#include "sim-server/scene/scene.hpp"

namespace splash::sim {

/// JSON. `particles`: of water, as there are; `spacing`: between them [m].
[[nodiscard]] std::string describe_for_viewers(const Scene& scene, int particles, double spacing);

[[nodiscard]] protocol::ViewFrame scene_frame(const Scene& scene, int particles, double spacing);

}  // namespace splash::sim
