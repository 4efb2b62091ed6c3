// SPDX-License-Identifier: MIT
#include "sim-server/simulation/missing_water.hpp"

#include <array>
#include <cmath>
#include <cstdio>

#include "sim-server/scene/initial_fluid.hpp"
#include "sim-server/scene/resolution.hpp"
#include "sim-server/start/scene_start.hpp"

namespace splash::sim {
namespace {

/// So much more or less is as the scene wants it [1].
constexpr double kRight = 0.002;

/// Of a block of which so much is there. Its level is that of as much more or less on all of its
/// area.
std::string account(std::size_t number, const WaterBlock& block, const BlockWater& water) {
  const double area = (block.upper[0] - block.lower[0]) * (block.upper[1] - block.lower[1]);
  const double level = block.upper[2] + (water.there - water.wanted) / area;
  std::array<char, 200> text = {};
  std::snprintf(text.data(), text.size(),
                "block %zu has %.3g litres for %.3g, so that its level is about %.4g m for %.4g",
                number, 1e3 * water.there, 1e3 * water.wanted, level, block.upper[2]);
  return text.data();
}

}  // namespace

std::string missing_water(const Simulation& simulation) {
  const Scene& scene = simulation.scene();
  const InitialWater water =
      initial_water(scene, poses_at_start(simulation.bodies()), scene_sound_speed(scene));
  std::string list;
  for (std::size_t b = 0; b < water.blocks.size(); ++b) {
    const BlockWater& block = water.blocks[b];
    if (std::abs(block.there - block.wanted) <= kRight * block.wanted) continue;
    list += (list.empty() ? "" : "; ") + account(b + 1, scene.water[b], block);
  }
  if (list.empty()) return {};
  return list + " (particles are too large for what bodies leave of it: more fluid.particles)";
}

}  // namespace splash::sim
