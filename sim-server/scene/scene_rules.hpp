// SPDX-License-Identifier: MIT
// The rules of a scene that span several keys: what cannot be said by one row's range.
#pragma once

#include "protocol/config.hpp"
#include "sim-server/scene/scene.hpp"

namespace splash::sim {

// Each throws protocol::ConfigError at the mapping that breaks the rule.
void check_tank(const protocol::ConfigMap& map, const Tank& tank);
void check_slope(const protocol::ConfigMap& map, const Slope& slope, const Tank& tank);
void check_wave_maker(const protocol::ConfigMap& map, const WaveMaker& maker, const Tank& tank);
/// `blocks` are the ones before it in the file.
void check_water(const protocol::ConfigMap& map, const WaterBlock& block, const Tank& tank,
                 const std::vector<WaterBlock>& blocks);
void check_shape(const protocol::ConfigMap& map, const Shape& shape);
void check_detect(const protocol::ConfigMap& map, const DetectSettings& detect);
/// Spacing or particles, one of them; a number of particles that can be simulated.
void check_resolution(const protocol::ConfigMap& fluid, const Scene& scene);

}  // namespace splash::sim
