// SPDX-License-Identifier: MIT
// The `gauges` mapping of a scene file: which probes there are.
#pragma once

#include "program/config.hpp"
#include "sim-server/scene/scene.hpp"

namespace splash::sim {

/// `map`: the mapping `gauges`; `scene`: its bodies and tank are known already. Throws
/// program::ConfigError at the key that is wrong.
[[nodiscard]] GaugesSettings read_gauges(const program::ConfigMap& map, const Scene& scene);

}  // namespace splash::sim
