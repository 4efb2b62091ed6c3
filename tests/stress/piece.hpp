// SPDX-License-Identifier: MIT
// What a long run has done so far, kept in a file, so that the next call goes on from there.
#pragma once

#include <cstdint>
#include <filesystem>

#include "sim-server/fluid/fluid.hpp"

namespace splash::stress {

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
