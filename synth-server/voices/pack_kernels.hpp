// SPDX-License-Identifier: MIT
// The two loops in which the synth spends its time, compiled once per instruction set and chosen
// when a pool is made, so that one program serves every processor. They give the same bits with
// each set.
#pragma once

#include <cstdint>

#include "synth-server/voices/bubble_pack.hpp"

namespace splash::synth {

/// In rising order; `best`: what this processor has.
enum class InstructionSet { portable, avx2, avx512, best };

/// How loudly each voice of a pack goes to one channel.
struct alignas(64) PackFeed {
  double gains[kPackVoices] = {};  ///< from metres to full scale [1/m]
};

/// The values of a cell, sample by sample: those of all lanes side by side.
inline constexpr int kRows = kCell * kPackVoices;

/// Packs that go to one channel together: its sums are fetched and put back once for all of them.
/// As many as have 32 KiB of rows in a cell, which stay in the first cache while all channels
/// fetch them.
inline constexpr int kMixedPacks = 4;
struct PackMix {
  int count = 0;
  const double* rows[kMixedPacks] = {};
  const PackFeed* feeds[kMixedPacks] = {};
};

struct PackKernels {
  /// Samples [from, to) of the cell: rows[16 (n - from) + lane] [m]. `rows` lies at a multiple of
  /// 64 bytes, as all that follows.
  void (*turn)(BubblePack& pack, int from, int to, double* rows);
  /// Adds these samples of up to kMixedPacks packs to one channel, whose sums are kRows values,
  /// some lanes apart.
  void (*mix)(const PackMix& packs, int from, int to, double* sums);
  /// Adds up the lanes of one channel, always in the same order, and clears them.
  void (*collect)(double* sums, int from, int to, double* out);
};

/// The best set not above `wanted` that this program and this processor have.
[[nodiscard]] InstructionSet available(InstructionSet wanted) noexcept;
[[nodiscard]] const char* name_of(InstructionSet set) noexcept;

[[nodiscard]] PackKernels pack_kernels(InstructionSet set) noexcept;

}  // namespace splash::synth
