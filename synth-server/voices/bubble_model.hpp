// SPDX-License-Identifier: MIT
// Which bubble is played: the paper's, or that of linear theory.
#pragma once

#include <limits>

#include "synth-server/voices/paper_bubble.hpp"
#include "synth-server/voices/physical_bubble.hpp"

namespace splash::synth {

enum class BubbleModel {
  paper,     ///< f0 r = 3 m/s, the fitted damping, the literal chirp unless told otherwise
  physical,  ///< Minnaert's frequency with surface tension, heat and depth; three dampings
};

/// No surface is known: bubbles are taken to lie right under it.
inline constexpr double kNoWaterLevel = -std::numeric_limits<double>::infinity();

/// How a bubble of this `radius` [m] and `epsilon` [1] at height `z` [m] sounds. `chirp` is the
/// paper's; `water_level` [m] the physical one's.
[[nodiscard]] inline BubbleTone bubble_tone(BubbleModel model, Chirp chirp, double water_level,
                                            double radius, double epsilon, double z) noexcept {
  if (model == BubbleModel::paper) return paper_bubble(radius, epsilon, chirp);
  return physical_bubble(radius, epsilon, water_level > z ? water_level - z : 0.0);
}

}  // namespace splash::synth
