// SPDX-License-Identifier: MIT
// What the synth does not do, for comparison, compiled once per instruction set: a chirp by single
// precision alone, started afresh from double precision now and then or never; and what the
// processor's vector unit can do at all.
#pragma once

#include "synth-server/voices/pack_kernels.hpp"

namespace splash::bench {

/// Sixteen voices as arrays: z, w and w's turn.
struct alignas(64) FloatPack {
  float re[16] = {}, im[16] = {}, turn_re[16] = {}, turn_im[16] = {}, rise_re[16] = {},
        rise_im[16] = {};
};

struct FloatLoops {
  /// 64 samples of each lane: samples[16 n + lane].
  void (*advance)(FloatPack& pack, float* samples);
  /// Multiplications and additions of whole vectors per second, one fused pair counting as one
  /// where the set has it; so many values a vector has.
  double (*vector_rate)();
  int lanes = 0;
  bool fused = false;
};
[[nodiscard]] FloatLoops float_loops(synth::InstructionSet set);

}  // namespace splash::bench
