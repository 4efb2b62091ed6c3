// SPDX-License-Identifier: MIT
// The bubble as the paper prints it (section 5.2, equation 3, after van den Doel 2005):
// p(t) = A0 sin(2 pi t f(t)) e^(-d t) with f(t) = f0 (1 + xi d t). The main cavity (section 5.3) is
// the same formula with a large radius and epsilon = 0.1, so there is no third voice.
#pragma once

#include <cmath>

#include "synth-server/voices/bubble_tone.hpp"
#include "synth-server/voices/sound.hpp"

namespace splash::synth {

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

}  // namespace splash::synth
