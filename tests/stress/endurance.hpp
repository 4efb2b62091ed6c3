// SPDX-License-Identifier: MIT
// Test S5: the built-in scenes for very many steps, one after the other: no reset, nobody lost,
// memory and file descriptors as at the beginning. A run may be broken off and gone on with.
#pragma once

#include <cstdint>
#include <filesystem>
#include <string>
#include <vector>

#include "sim-server/device/device.hpp"
#include "sim-server/fluid/fluid.hpp"
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

// What a long run has done so far, kept in a file, so that the next call goes on from there.

struct Piece {
  std::int64_t steps = 0;
  double simulated = 0.0;   ///< [s]
  double wall = 0.0;        ///< [s]
  double growth = 0.0;      ///< of memory, in the piece where it grew most [MiB]
  double hours = 0.0;       ///< that this piece took
  std::int64_t opened = 0;  ///< file descriptors more at a piece's end than after its first tenth
  std::int64_t lost = 0;    ///< particles
  std::int64_t again = 0;   ///< frames computed again
  std::int64_t given_up = 0;
  std::int64_t resets = 0;
  std::int64_t events = 0;
  sim::Snapshot water;
};

/// False if there is none.
[[nodiscard]] bool read_piece(const std::filesystem::path& file, Piece& piece);
/// Whole or not at all.
void write_piece(const std::filesystem::path& file, const Piece& piece);

}  // namespace splash::stress
