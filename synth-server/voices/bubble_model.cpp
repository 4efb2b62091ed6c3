// SPDX-License-Identifier: MIT
#include "synth-server/voices/bubble_model.hpp"

#include <cmath>

#include "synth-server/voices/paper_bubble.hpp"
#include "synth-server/voices/physical_bubble.hpp"

namespace splash::synth {
namespace {

/// From `a` to `b`, both positive, evenly in the logarithm; exactly these at the ends.
double between(double a, double b, double part) noexcept {
  if (part <= 0.0) return a;
  return part >= 1.0 ? b : a * std::pow(b / a, part);
}

}  // namespace

BubbleTone bubble_tone(const ToneSound& sound, double radius, double epsilon,
                       double depth) noexcept {
  BubbleTone tone = paper_bubble(radius, epsilon, sound);
  if (sound.physical > 0.0) {
    const BubbleResonance found = resonance(radius, depth);
    tone.frequency = between(tone.frequency, found.frequency, sound.physical);
    tone.damping = between(tone.damping, found.damping(), sound.physical);
  }
  tone.amplitude = std::pow(epsilon, sound.excitation) * radius;
  tone.frequency *= sound.pitch;
  tone.damping *= sound.damping;
  tone.rise = sound.rise * tone.damping;
  return tone;
}

}  // namespace splash::synth
