// SPDX-License-Identifier: MIT
// The mix of one cell: 64 samples of each channel, begun at a multiple of 64 of the clock.
#pragma once

#include <cmath>
#include <vector>

#include "protocol/event.hpp"
#include "synth-server/voices/bubble_pack.hpp"

namespace splash::synth {

/// A gain over one cell: it goes evenly from its first sample to the first one of the next cell.
struct CellGain {
  double begin = 1.0;  ///< [1]
  double end = 1.0;    ///< [1]

  [[nodiscard]] bool is_one() const noexcept { return begin == 1.0 && end == 1.0; }
  /// At sample `n` of the cell.
  [[nodiscard]] double at(int n) const noexcept { return begin + (end - begin) * n / kCell; }
};

[[nodiscard]] inline double gain_of(double decibels) noexcept {
  return std::pow(10.0, decibels / 20.0);
}

struct Mix {
  explicit Mix(std::size_t channels) : samples(channels * kCell, 0.0), touched(channels, 0) {}

  std::vector<double> samples;       ///< channel by channel, kCell each [full scale]
  std::vector<char> touched;         ///< per channel: a voice was added
  protocol::ByKind<CellGain> gains;  ///< by which the voices of each component are added
};

}  // namespace splash::synth
