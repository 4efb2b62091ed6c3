// SPDX-License-Identifier: MIT
// What every bubble and cavity sounds like, whatever model gave its four numbers: a sine whose
// pitch rises steadily and whose amplitude falls,
//   p(t) = A sin(2 pi f0 (t + c t^2)) e^(-d t),   instantaneous frequency f0 (1 + 2 c t).
#pragma once

#include <cmath>
#include <limits>
#include <numbers>

#include "synth-server/voices/sound.hpp"
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

// The bubble as the paper prints it (section 5.2, equation 3, after van den Doel 2005):
// p(t) = A0 sin(2 pi t f(t)) e^(-d t) with f(t) = f0 (1 + xi d t). The main cavity (section 5.3) is
// the same formula with a large radius and epsilon = 0.1, so there is no third voice.

/// Resonance frequency at birth [Hz] of a bubble of radius r [m], after Minnaert 1933.
[[nodiscard]] inline double paper_frequency(double radius, const ToneSound& sound = {}) noexcept {
  return sound.minnaert / radius;
}

/// Damping d [1/s]: viscous, radiative and thermal, as fitted in paper section 5.2.1.
[[nodiscard]] inline double paper_damping(double radius, const ToneSound& sound = {}) noexcept {
  return sound.radiation / radius + sound.thermal / (radius * std::sqrt(radius));
}

/// `radius` [m], `epsilon` [1]: amplitude A0 = epsilon r.
[[nodiscard]] inline BubbleTone paper_bubble(double radius, double epsilon,
                                             const ToneSound& sound = {}) noexcept {
  const double damping = paper_damping(radius, sound);
  return {epsilon * radius, paper_frequency(radius, sound), damping, sound.rise * damping};
}

// Which bubble is played: the paper's, that of linear theory, or one between them, and how far a
// sound departs from it.

/// No surface is known: bubbles are taken to lie right under it.
inline constexpr double kNoWaterLevel = -std::numeric_limits<double>::infinity();

/// No floor is known: bubbles are far from it.
inline constexpr double kNoFloor = -std::numeric_limits<double>::infinity();

/// How a bubble of this `radius` [m] and `epsilon` [1] sounds, whose middle lies `depth` [m] under
/// the surface, which only linear theory asks for.
[[nodiscard]] BubbleTone bubble_tone(const ToneSound& sound, double radius, double epsilon,
                                     double depth) noexcept;

}  // namespace splash::synth
