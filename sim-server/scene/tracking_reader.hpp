// SPDX-License-Identifier: MIT
// `tracking` of a scene: which messages move which body.
#pragma once

#include "program/config.hpp"
#include "sim-server/scene/scene.hpp"

namespace splash::sim {

/// `scene` has its bodies already. Throws program::ConfigError.
[[nodiscard]] TrackingSettings read_tracking(const program::ConfigMap& map, const Scene& scene);

}  // namespace splash::sim
