// SPDX-License-Identifier: MIT
// A pack and its samples, for the tests of the voices.
#pragma once

#include <array>
#include <cstddef>

#include "synth-server/voices/pack_kernels.hpp"

namespace splash::synth {

class PackPlayer {
 public:
  explicit PackPlayer(const PackKernels& kernels) : kernels_(kernels) {}

  void seat(std::size_t lane, const BubbleTone& tone, double rate, int ahead) {
    set_lane(pack_, lane, tone, rate, ahead);
  }
  void render(int from, int to) {
    kernels_.turn(pack_, from, to, &rows_[static_cast<std::size_t>(from) * kPackVoices]);
  }
  [[nodiscard]] double at(std::size_t lane, int n) const {
    return rows_[static_cast<std::size_t>(n) * kPackVoices + lane];
  }

 private:
  PackKernels kernels_;
  BubblePack pack_{};
  alignas(64) std::array<double, kRows> rows_{};
};

}  // namespace splash::synth
