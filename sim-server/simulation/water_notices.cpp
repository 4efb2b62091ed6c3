// SPDX-License-Identifier: MIT
#include "sim-server/simulation/water_notices.hpp"

#include <array>
#include <cmath>
#include <cstdio>
#include <set>
#include "sim-server/scene/initial_fluid.hpp"
#include "sim-server/scene/resolution.hpp"
#include "sim-server/scene/rotation.hpp"
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

namespace {

/// Where a particle counts as in a block although its layers were squeezed or spread [m].
constexpr double kTouch = 0.01;

bool is_in(const WaterBlock& block, const Vector3& x) {
  for (std::size_t i = 0; i < 3; ++i) {
    if (x[i] < block.lower[i] - kTouch || x[i] > block.upper[i] + kTouch) return false;
  }
  return true;
}

/// Numbers of the blocks, from 0, that such particles are in.
std::set<std::size_t> blocks_of(Simulation& simulation) {
  const Snapshot now = simulation.fluid().snapshot();
  const std::vector<WaterBlock>& water = simulation.scene().water;
  std::set<std::size_t> blocks;
  for (std::size_t i = 0; i < now.id.size(); ++i) {
    if (simulation.support_states()[static_cast<std::size_t>(now.id[i])] == SupportState::supported)
      continue;
    for (std::size_t b = 0; b < water.size(); ++b) {
      if (!is_in(water[b], now.place(i))) continue;
      blocks.insert(b);
      break;
    }
  }
  return blocks;
}

std::string corner(const Vector3& x) {
  std::array<char, 96> text = {};
  std::snprintf(text.data(), text.size(), "%g %g %g", x[0], x[1], x[2]);
  return text.data();
}

}  // namespace

std::string unsupported_water(Simulation& simulation) {
  const Scene& scene = simulation.scene();
  const bool has_weight = length(scene.fluid.gravity) > 0.0 || length(scene.fluid.pull) > 0.0;
  if (scene.fluid.settle != SettleKind::automatic || !has_weight) return {};
  std::string list;
  for (const std::size_t b : blocks_of(simulation)) {
    list += list.empty() ? "" : "; ";
    list += std::to_string(b + 1) + ", from " + corner(scene.water[b].lower) + " to " +
            corner(scene.water[b].upper);
  }
  if (list.empty()) return {};
  return "nothing holds block " + list +
         " of the water: it begins there and as the scene says, not settled (fluid.settle: always "
         "lets it flow or fall before time begins; a gate or bodies would hold it)";
}

}  // namespace splash::sim
