// SPDX-License-Identifier: MIT
// `tracking` of a scene: which messages move which body.
#pragma once

#include "protocol/config.hpp"
#include "sim-server/scene/scene.hpp"

namespace splash::sim {

/// `scene` has its bodies already. Throws protocol::ConfigError.
[[nodiscard]] TrackingSettings read_tracking(const protocol::ConfigMap& map, const Scene& scene);

}  // namespace splash::sim
