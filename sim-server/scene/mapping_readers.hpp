// SPDX-License-Identifier: MIT
// The readers of single mappings of a scene file, for scene_reader.cpp.
#pragma once

#include "program/config.hpp"
#include "sim-server/scene/scene.hpp"

namespace splash::sim {

// The `gauges` mapping of a scene file: which probes there are.

/// `map`: the mapping `gauges`; `scene`: its bodies and tank are known already. Throws
/// program::ConfigError at the key that is wrong.
[[nodiscard]] GaugesSettings read_gauges(const program::ConfigMap& map, const Scene& scene);

// `tracking` of a scene: which messages move which body.

/// `scene` has its bodies already. Throws program::ConfigError.
[[nodiscard]] TrackingSettings read_tracking(const program::ConfigMap& map, const Scene& scene);

// The mappings of a scene file that say where the water is and how it moves when time begins.

// Each takes the whole scene's mapping and throws program::ConfigError at the key that is wrong.

/// Blocks of water and the gate; the tank is known already.
void read_water(const program::ConfigMap& map, Scene& scene);
/// How the water moves when time begins.
void read_flow(const program::ConfigMap& map, Scene& scene);

}  // namespace splash::sim
