// SPDX-License-Identifier: MIT
#include "sim-server/simulation/unsupported_water.hpp"

#include <array>
#include <cstdio>
#include <set>

#include "sim-server/scene/rotation.hpp"

namespace splash::sim {
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
  const auto stride = static_cast<std::size_t>(simulation.fluid().params().capacity);
  const std::vector<WaterBlock>& water = simulation.scene().water;
  std::set<std::size_t> blocks;
  for (std::size_t i = 0; i < now.id.size(); ++i) {
    if (simulation.support_states()[static_cast<std::size_t>(now.id[i])] == SupportState::supported)
      continue;
    const auto at = [&](std::size_t axis) {
      return static_cast<double>(now.position[axis * stride + i]);
    };
    for (std::size_t b = 0; b < water.size(); ++b) {
      if (!is_in(water[b], {at(0), at(1), at(2)})) continue;
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
