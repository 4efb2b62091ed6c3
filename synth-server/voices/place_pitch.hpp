// SPDX-License-Identifier: MIT
// Pitch from place: a bubble near the surface has less water to move than Minnaert's, one near a
// floor more. Of a bubble of radius r whose middle lies h under the surface, with x = r / (2 h),
//   f = f0 / sqrt(1 - x - x^4)         (M. Strasberg 1953, J. Acoust. Soc. Am. 25),
// and h over a rigid floor, f = f0 / sqrt(1 + x). A bubble rises at its terminal speed u (H. D.
// Mendelson 1967: u^2 = 2.14 sigma / (rho 2 r) + 0.505 g 2 r), so its pitch rises only where the
// surface is near, by df/dt = -u df/dh; the phase has half of that (bubble_tone.hpp).
#pragma once

#include "synth-server/voices/bubble_tone.hpp"
#include "synth-server/voices/sound.hpp"

namespace splash::synth {

/// Pitch over that of the same bubble far from everything [1]; `radius`, `depth` [m]. Less deep
/// than its radius it counts as touching.
[[nodiscard]] double pitch_under_surface(double radius, double depth) noexcept;
/// The same over a rigid floor at a height [m].
[[nodiscard]] double pitch_over_floor(double radius, double height) noexcept;
/// d ln f / dt under the surface, of a bubble that rises [1/s].
[[nodiscard]] double rise_under_surface(double radius, double depth) noexcept;

/// Where a bubble's middle lies; infinite: not known, or far [m].
struct Place {
  double depth = 0.0;   ///< under the surface
  double height = 0.0;  ///< over the floor
};

/// As far as the sound says.
[[nodiscard]] BubbleTone in_place(const ToneSound& sound, BubbleTone tone, double radius,
                                  const Place& place) noexcept;

}  // namespace splash::synth
