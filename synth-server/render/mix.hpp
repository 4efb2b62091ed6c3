// SPDX-License-Identifier: MIT
// The mix of one cell: 64 samples of each channel, begun at a multiple of 64 of the clock.
#pragma once

#include <vector>

#include "synth-server/voices/bubble_pack.hpp"

namespace splash::synth {

struct Mix {
  explicit Mix(std::size_t channels) : samples(channels * kCell, 0.0), touched(channels, 0) {}

  std::vector<double> samples;  ///< channel by channel, kCell each [full scale]
  std::vector<char> touched;    ///< per channel: a voice was added
};

}  // namespace splash::synth
