// SPDX-License-Identifier: MIT
// Test S5: the built-in scenes for very many steps, one after the other: no reset, nobody lost,
// memory and file descriptors as at the beginning. A run may be broken off and gone on with.
#pragma once

#include <cstdint>
#include <filesystem>
#include <string>
#include <vector>

#include "sim-server/device/device.hpp"
#include "sim-server/scene/scene.hpp"

namespace splash::stress {

struct Endurance {
  std::vector<std::string> scenes;  ///< of configs/scenes; empty: all
  std::int64_t steps = 1'000'000;   ///< that each shall take; only those that are computed count
  double coarser = 1.0;             ///< spacings are this many times the scene's [1]
  double minutes = 0.0;             ///< ends after so long, to be gone on with; 0: never [min]
  sim::PressureKind solver = sim::PressureKind::weakly_compressible;
};

/// Names of the built-in scenes.
[[nodiscard]] std::vector<std::string> built_in_scenes();
/// One of them as the endurance run has it: motions repeat, nothing idles.
[[nodiscard]] sim::Scene built_in_scene(const std::string& name, const Endurance& wanted);

/// Runs each scene until it has taken its steps, those of earlier calls included, which are kept in
/// `out`: tells how it fares and leaves endurance-*.csv there. How many scenes did not pass. Memory
/// is compared with that after the first tenth of a call.
[[nodiscard]] int endure(sim::Device& device, const Endurance& wanted,
                         const std::filesystem::path& out);

}  // namespace splash::stress
