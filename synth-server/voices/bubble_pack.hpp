// SPDX-License-Identifier: MIT
// Sixteen bubbles or cavities side by side, one to a lane, so that compilers advance them all at
// once. Each is a complex number z that turns and shrinks, multiplied every sample by a number that
// itself turns at constant speed (a linear chirp needs no sine per sample); its imaginary part is
// the sound. Even and odd samples go their own ways, two samples at a step: half as many roundings
// in a row, and the processor need not wait for the one while it works on the other. Two settings:
//   exact: in double precision throughout. Rounding stays 145 dB down over the longest life.
//   fast:  in single precision, started afresh every cell from a double precision that advances
//          cell by cell. Single precision alone would be wrong within a second, and may even grow
//          without bound.
// Time runs in cells of 64 samples. A voice that starts within a cell has its formula continued
// backwards to the cell's beginning, so that all lanes march in step.
#pragma once

#include <cstddef>

#include "synth-server/voices/bubble_tone.hpp"

namespace splash::synth {

inline constexpr int kCell = 64;        ///< samples
inline constexpr int kPackVoices = 16;  ///< lanes

/// Sixteen complex numbers.
template <class Real>
struct ComplexLanes {
  Real re[kPackVoices] = {};
  Real im[kPackVoices] = {};
};

/// What turns: [0] the even samples, [1] the odd ones.
template <class RealNumber>
struct alignas(64) TurningLanes {
  using Real = RealNumber;
  ComplexLanes<Real> sound[2];  ///< z of the next even and of the next odd sample [m]
  ComplexLanes<Real> turn[2];   ///< from each to the one after the next
  ComplexLanes<Real> rise;      ///< the turn's own turn in that time
};

struct ExactPack : TurningLanes<double> {};

struct FastPack : TurningLanes<float> {
  // What the next cell starts from, and what brings that to the cell after it.
  ComplexLanes<double> cell_sound;      ///< z of its first sample
  ComplexLanes<double> cell_leap;       ///< from there to the cell after it
  ComplexLanes<double> cell_leap_rise;  ///< from cell_leap to the next
  ComplexLanes<double> first_turn;      ///< from its first sample to its second
  ComplexLanes<double> first_turn_rise;
  ComplexLanes<double> pair_turn;  ///< from its first sample to its third
  ComplexLanes<double> pair_turn_rise;
  ComplexLanes<float> half_rise;  ///< from a sample's turn to the next sample's
};

/// Puts a tone into a lane whose cell begins `ahead` samples before the tone does. For a cell of
/// which nothing was rendered yet.
void set_lane(ExactPack& pack, std::size_t lane, const BubbleTone& tone, double sample_rate,
              int ahead) noexcept;
void set_lane(FastPack& pack, std::size_t lane, const BubbleTone& tone, double sample_rate,
              int ahead) noexcept;

/// Copies one lane into another pack's.
void copy_lane(const ExactPack& from, ExactPack& to, std::size_t lane) noexcept;
void copy_lane(const FastPack& from, FastPack& to, std::size_t lane) noexcept;

}  // namespace splash::synth
