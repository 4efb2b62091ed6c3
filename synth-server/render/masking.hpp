// SPDX-License-Identifier: MIT
// Bubbles that nobody could tell from what sounds already: in each channel that they reach, a voice
// of the same third of an octave is there, rings longer, and is so much stronger that all bubbles
// left out in its favour together have at most 3/1000 of its power (-25 dB): 20 dB below what
// sounds even where strong voices partly cancel each other. That changes a level by 0.04 dB; the
// smallest difference that is noticed is 1.6 dB for touch and about 1 dB for hearing.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "synth-server/render/ranking.hpp"
#include "synth-server/render/routing.hpp"
#include "synth-server/voices/bubble_tone.hpp"

namespace splash::synth {

class Masking {
 public:
  /// Power of all that is left out, in parts of the masker's.
  static constexpr double kMostPower = 0.003;

  Masking(int channels, double sample_rate);

  /// Whether the tone may be left out; counts it as such if so. `ranking`: of the voices that were
  /// noted.
  bool covers(const BubbleTone& tone, std::span<const Route> routes, std::int64_t sample,
              const Ranking& ranking) noexcept;
  /// The tone sounds from `sample` on, in this place of the ranking.
  void note(const BubbleTone& tone, std::span<const Route> routes, std::int64_t sample,
            std::uint32_t place, const Ranking& ranking) noexcept;

 private:
  static constexpr int kBands = 36;  ///< thirds of an octave from 8 Hz on
  struct Masker {
    std::uint32_t place = Ranking::kNone;
    std::int64_t since = 0;  ///< sample
    double log_gain = 0.0;   ///< of its channel [ln 1/m]
    double frequency = 0.0;  ///< at birth [Hz]
    double rise = 0.0;       ///< c [1/s]
    double left_out = 0.0;   ///< power, in parts of its own
  };
  static int band_of(double frequency) noexcept;
  [[nodiscard]] Masker& at(int channel, int band) noexcept;
  /// Power of a tone that is this loud now, in parts of the masker's; infinite without one.
  [[nodiscard]] double ratio(const Masker& masker, double log_level, std::int64_t sample,
                             const Ranking& ranking) const noexcept;

  double sample_rate_;
  std::vector<Masker> maskers_;  ///< channel by channel, kBands each
};

}  // namespace splash::synth
