// SPDX-License-Identifier: MIT
// The mappings of a scene file that say where the water is and how it moves when time begins.
#pragma once

#include "program/config.hpp"
#include "sim-server/scene/scene.hpp"

namespace splash::sim {

// Each takes the whole scene's mapping and throws program::ConfigError at the key that is wrong.

/// Blocks of water and the gate; the tank is known already.
void read_water(const program::ConfigMap& map, Scene& scene);
/// How the water moves when time begins.
void read_flow(const program::ConfigMap& map, Scene& scene);

}  // namespace splash::sim
