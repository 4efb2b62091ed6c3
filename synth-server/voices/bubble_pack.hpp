// SPDX-License-Identifier: MIT
// Sixteen bubbles or cavities side by side, one to a lane, so that compilers advance them all at
// once. Each is a complex number z that turns and shrinks, multiplied every sample by a number that
// itself turns at constant speed (a linear chirp needs no sine per sample); its imaginary part is
// the sound. Even and odd samples go their own ways, two samples at a step: half as many roundings
// in a row, and the processor need not wait for the one while it works on the other. In double
// precision throughout: rounding stays 145 dB down over the longest life. Single precision would be
// wrong within a second, and may even grow without bound.
// Time runs in cells of 64 samples. A voice that starts within a cell has its formula continued
// backwards to the cell's beginning, so that all lanes march in step.
#pragma once

#include <cstddef>

#include "synth-server/voices/bubble_tone.hpp"

namespace splash::synth {

inline constexpr int kCell = 64;        ///< samples
inline constexpr int kPackVoices = 16;  ///< lanes

/// Sixteen complex numbers.
struct ComplexLanes {
  double re[kPackVoices] = {};
  double im[kPackVoices] = {};
};

/// [0] of the even samples, [1] of the odd ones.
struct alignas(64) BubblePack {
  ComplexLanes sound[2];  ///< z of the next even and of the next odd sample [m]
  ComplexLanes turn[2];   ///< from each to the one after the next
  ComplexLanes rise;      ///< the turn's own turn in that time
};

/// Puts a tone into a lane whose cell begins `ahead` samples before the tone does. For a cell of
/// which nothing was rendered yet.
void set_lane(BubblePack& pack, std::size_t lane, const BubbleTone& tone, double sample_rate,
              int ahead) noexcept;

/// Copies one lane into another pack's.
void copy_lane(const BubblePack& from, BubblePack& to, std::size_t lane) noexcept;

}  // namespace splash::synth
