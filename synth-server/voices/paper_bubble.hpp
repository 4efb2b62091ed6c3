// SPDX-License-Identifier: MIT
// The bubble as the paper prints it (section 5.2, equation 3, after van den Doel 2005):
// p(t) = A0 sin(2 pi t f(t)) e^(-d t) with f(t) = f0 (1 + xi d t). The main cavity (section 5.3) is
// the same formula with a large radius and epsilon = 0.1, so there is no third voice.
#pragma once

#include <cmath>

#include "synth-server/voices/bubble_tone.hpp"

namespace splash::synth {

/// f0 r [m/s]; paper section 5.2.1, after Minnaert 1933 (whose theory gives 3.26 to 3.29).
inline constexpr double kMinnaert = 3.0;
/// xi [1], the rise of the pitch; paper section 5.2.1, found by ear by van den Doel.
inline constexpr double kRise = 0.1;

/// What f(t) = f0 (1 + xi d t) means. The printed sin(2 pi t f(t)) has the *instantaneous*
/// frequency f0 (1 + 2 xi d t), because the phase's derivative acts on both t. Oscillators that
/// integrate f (most patches) rise half as fast: f0 (1 + xi d t).
enum class Chirp { literal, integrated };

/// Resonance frequency at birth [Hz] of a bubble of radius r [m].
[[nodiscard]] inline double paper_frequency(double radius) noexcept {
  return kMinnaert / radius;
}

/// Damping d [1/s]: viscous, radiative and thermal, as fitted in paper section 5.2.1.
[[nodiscard]] inline double paper_damping(double radius) noexcept {
  return 0.13 / radius + 0.0072 / (radius * std::sqrt(radius));
}

/// `radius` [m], `epsilon` [1]: amplitude A0 = epsilon r.
[[nodiscard]] inline BubbleTone paper_bubble(double radius, double epsilon, Chirp chirp) noexcept {
  const double damping = paper_damping(radius);
  const double rise = (chirp == Chirp::literal ? 1.0 : 0.5) * kRise * damping;
  return {epsilon * radius, paper_frequency(radius), damping, rise};
}

}  // namespace splash::synth
