// SPDX-License-Identifier: MIT
// The sound of one air bubble as the paper prints it (section 5.2, equation 3, after van den Doel
// 2005): p(t) = A0 sin(2 pi t f(t)) e^(-d t). The main cavity (section 5.3) is the same formula
// with a large radius and epsilon = 0.1, so there is no third voice.
#pragma once

#include <cmath>
#include <numbers>

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
[[nodiscard]] inline double bubble_frequency(double radius) noexcept {
  return kMinnaert / radius;
}

/// Damping d [1/s]: viscous, radiative and thermal; paper section 5.2.1.
[[nodiscard]] inline double bubble_damping(double radius) noexcept {
  return 0.13 / radius + 0.0072 / (radius * std::sqrt(radius));
}

/// c [1/s] in phase(t) = 2 pi f0 (t + c t^2); instantaneous frequency f0 (1 + 2 c t).
[[nodiscard]] inline double bubble_chirp(double radius, Chirp chirp) noexcept {
  return (chirp == Chirp::literal ? 1.0 : 0.5) * kRise * bubble_damping(radius);
}

/// p(t) [m, as A0 = epsilon r is one]: the reference the voices are tested against.
[[nodiscard]] inline double bubble_pressure(double radius, double epsilon, double t,
                                            Chirp chirp) noexcept {
  const double turns = bubble_frequency(radius) * t * (1.0 + bubble_chirp(radius, chirp) * t);
  return epsilon * radius * std::sin(2.0 * std::numbers::pi * turns) *
         std::exp(-bubble_damping(radius) * t);
}

}  // namespace splash::synth
