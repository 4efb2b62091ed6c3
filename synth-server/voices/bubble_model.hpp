// SPDX-License-Identifier: MIT
// Which bubble is played: the paper's, that of linear theory, or one between them, and how far a
// sound departs from it.
#pragma once

#include <limits>

#include "synth-server/voices/bubble_tone.hpp"
#include "synth-server/voices/sound.hpp"

namespace splash::synth {

/// No surface is known: bubbles are taken to lie right under it.
inline constexpr double kNoWaterLevel = -std::numeric_limits<double>::infinity();

/// No floor is known: bubbles are far from it.
inline constexpr double kNoFloor = -std::numeric_limits<double>::infinity();

/// How a bubble of this `radius` [m] and `epsilon` [1] sounds, whose middle lies `depth` [m] under
/// the surface, which only linear theory asks for.
[[nodiscard]] BubbleTone bubble_tone(const ToneSound& sound, double radius, double epsilon,
                                     double depth) noexcept;

}  // namespace splash::synth
