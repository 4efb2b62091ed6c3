// SPDX-License-Identifier: MIT
// What every bubble and cavity sounds like, whatever model gave its four numbers: a sine whose
// pitch rises steadily and whose amplitude falls,
//   p(t) = A sin(2 pi f0 (t + c t^2)) e^(-d t),   instantaneous frequency f0 (1 + 2 c t).
#pragma once

#include <cmath>
#include <numbers>

#include "synth-server/voices/voice_life.hpp"

namespace splash::synth {

struct BubbleTone {
  double amplitude = 0.0;  ///< A [m]
  double frequency = 0.0;  ///< f0 [Hz]
  double damping = 0.0;    ///< d [1/s]
  double rise = 0.0;       ///< c [1/s]
};

/// p(t) [m] in closed form: the reference that the running voices are tested against.
[[nodiscard]] inline double pressure(const BubbleTone& tone, double t) noexcept {
  const double turns = tone.frequency * t * (1.0 + tone.rise * t);
  return tone.amplitude * std::sin(2.0 * std::numbers::pi * turns) * std::exp(-tone.damping * t);
}

/// `sample_rate` [Hz]; `floor` [m]: amplitude under which the voice is over.
[[nodiscard]] VoiceLife life_of(const BubbleTone& tone, double sample_rate, double floor) noexcept;

}  // namespace splash::synth
