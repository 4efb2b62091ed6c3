// SPDX-License-Identifier: MIT
// The two loops in which the synth spends its time, compiled once per instruction set and chosen
// when a pool is made, so that one program serves every processor. The exact setting gives the same
// bits with each of them; the fast one multiplies and adds in one rounding where the set can.
#pragma once

#include <cstdint>

#include "synth-server/voices/bubble_pack.hpp"

namespace splash::synth {

/// In rising order; `best`: what this processor has.
enum class InstructionSet { portable, avx2, avx512, best };

/// Where a voice goes and how loudly.
template <class Real>
struct Feed {
  std::int32_t channel = 0;
  Real gain = 0;  ///< from metres to full scale [1/m]
};

template <class Pack>
struct PackKernels {
  using Real = typename Pack::Real;
  /// Samples [from, to) of the cell, lane by lane: samples[64 lane + n] [m]. `samples` lies at a
  /// multiple of 64 bytes, as all that follows.
  void (*advance)(Pack& pack, int from, int to, Real* samples);
  /// Adds them to their channels: channels[64 channel + n] [full scale]. Lane k has counts[k] feeds
  /// from feeds[k stride] on.
  void (*mix)(const Real* samples, int from, int to, const Feed<Real>* feeds, int stride,
              const std::int32_t* counts, Real* channels);
};

/// The best set not above `wanted` that this program and this processor have.
[[nodiscard]] InstructionSet available(InstructionSet wanted) noexcept;
[[nodiscard]] const char* name_of(InstructionSet set) noexcept;

[[nodiscard]] PackKernels<ExactPack> exact_kernels(InstructionSet set) noexcept;
[[nodiscard]] PackKernels<FastPack> fast_kernels(InstructionSet set) noexcept;

}  // namespace splash::synth
