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

/// How loudly each voice of a pack goes to one channel.
template <class Real>
struct alignas(64) PackFeed {
  Real gains[kPackVoices] = {};  ///< from metres to full scale [1/m]
};

/// The values of a cell, sample by sample: those of all lanes side by side.
inline constexpr int kRows = kCell * kPackVoices;

/// Packs that go to one channel together: its sums are fetched and put back once for all of them.
/// As many as have 32 KiB of rows in a cell, which stay in the first cache while all channels
/// fetch them.
template <class Real>
inline constexpr int kMixedPacks = sizeof(Real) == sizeof(double) ? 4 : 8;
template <class Real>
struct PackMix {
  int count = 0;
  const Real* rows[kMixedPacks<Real>] = {};
  const PackFeed<Real>* feeds[kMixedPacks<Real>] = {};
};

template <class Pack>
struct PackKernels {
  using Real = typename Pack::Real;
  /// At the beginning of a cell: what turns in it, into `lanes`, and the pack goes on to the next
  /// one. Of the exact setting, which is never started afresh, the lanes are the pack's own.
  void (*begin)(Pack& pack, TurningLanes<Real>& lanes);
  /// Samples [from, to) of the cell: rows[16 (n - from) + lane] [m]. `rows` lies at a multiple of
  /// 64 bytes, as all that follows.
  void (*turn)(TurningLanes<Real>& lanes, int from, int to, Real* rows);
  /// Adds these samples of up to kMixedPacks packs to one channel, whose sums are kRows values,
  /// some lanes apart.
  void (*mix)(const PackMix<Real>& packs, int from, int to, Real* sums);
  /// The same to two channels that the same packs go to: their rows are fetched once for both.
  void (*mix_two)(const PackMix<Real>& packs, const PackMix<Real>& other, int from, int to,
                  Real* sums, Real* other_sums);
  /// Adds up the lanes of one channel, always in the same order, and clears them.
  void (*collect)(Real* sums, int from, int to, double* out);

  /// begin() where a cell begins, and turn(): for a pack that keeps its lanes.
  void advance(Pack& pack, int from, int to, Real* rows) const {
    if (from == 0) begin(pack, pack);
    turn(pack, from, to, rows);
  }
};

/// The best set not above `wanted` that this program and this processor have.
[[nodiscard]] InstructionSet available(InstructionSet wanted) noexcept;
[[nodiscard]] const char* name_of(InstructionSet set) noexcept;

[[nodiscard]] PackKernels<ExactPack> exact_kernels(InstructionSet set) noexcept;
[[nodiscard]] PackKernels<FastPack> fast_kernels(InstructionSet set) noexcept;

}  // namespace splash::synth
