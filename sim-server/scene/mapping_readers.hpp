// SPDX-License-Identifier: MIT
// The readers of single mappings of a scene file, for scene_reader.cpp.
#pragma once

#include <algorithm>
#include <string>
#include <vector>

#include "program/config.hpp"
#include "sim-server/scene/scene_table.hpp"

namespace splash::sim {

/// The row of a key that `map` has although a mapping of these kinds does not use it, which is a
/// mistake, not a no-op; null: there is none.
template <class Struct>
[[nodiscard]] const program::Row* foreign_key(const program::ConfigMap& map,
                                              const Fields<Struct>& fields,
                                              const std::vector<std::string>& kinds) {
  const auto found = std::find_if(fields.begin(), fields.end(), [&](const auto& field) {
    const std::vector<std::string>& users = field.row.kinds;
    return !users.empty() && map.has(field.row.key) &&
           std::find_first_of(users.begin(), users.end(), kinds.begin(), kinds.end()) ==
               users.end();
  });
  return found == fields.end() ? nullptr : &found->row;
}

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
