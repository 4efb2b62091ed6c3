// SPDX-License-Identifier: MIT
// A bubble or a cavity, sample by sample: a complex number that turns and shrinks, turned by a
// second one that itself turns at constant speed (a linear chirp needs no sine per sample).
// Four samples side by side, so that compilers vectorise; double precision, so that rounding stays
// 145 dB down over the longest life without being re-seeded (in float, it can even grow).
#pragma once

#include <array>

#include "synth-server/voices/bubble_formula.hpp"
#include "synth-server/voices/voice_life.hpp"

namespace splash::synth {

class BubbleVoice {
 public:
  BubbleVoice() = default;
  /// `radius` [m] and `epsilon` [1] positive, `sample_rate` [Hz].
  BubbleVoice(double radius, double epsilon, double sample_rate, Chirp chirp) noexcept;

  /// Writes the next `count` samples [m].
  void render(double* out, int count) noexcept;

 private:
  static constexpr std::size_t kLanes = 4;
  using Lanes = std::array<double, kLanes>;
  void advance() noexcept;
  void write_one(double* out) noexcept;

  alignas(64) Lanes re_{};       ///< lane k: p at sample k of the current four, as e^(i phase)
  alignas(64) Lanes im_{};       ///< its imaginary part is the sound
  alignas(64) Lanes turn_re_{};  ///< factor from sample k to sample k + 4
  alignas(64) Lanes turn_im_{};
  double rise_re_ = 1.0;  ///< factor of the factors: the chirp
  double rise_im_ = 0.0;
  std::size_t next_ = 0;  ///< lane that is written next
};

/// `floor` [m]: amplitude under which the voice is over.
[[nodiscard]] VoiceLife bubble_life(double radius, double epsilon, double sample_rate, Chirp chirp,
                                    double floor) noexcept;

}  // namespace splash::synth
