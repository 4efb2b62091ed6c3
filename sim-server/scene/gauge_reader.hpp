// SPDX-License-Identifier: MIT
// The `gauges` mapping of a scene file: which probes there are.
#pragma once

#include "protocol/config.hpp"
#include "sim-server/scene/scene.hpp"

namespace splash::sim {

/// `map`: the mapping `gauges`; `scene`: its bodies and tank are known already. Throws
/// protocol::ConfigError at the key that is wrong.
[[nodiscard]] GaugesSettings read_gauges(const protocol::ConfigMap& map, const Scene& scene);

}  // namespace splash::sim
