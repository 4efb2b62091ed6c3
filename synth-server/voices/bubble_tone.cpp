// SPDX-License-Identifier: MIT
#include "synth-server/voices/bubble_tone.hpp"

#include <algorithm>
#include <cmath>

#include "synth-server/voices/physical_bubble.hpp"

namespace splash::synth {

VoiceLife life_of(const BubbleTone& tone, double sample_rate, double floor) noexcept {
  VoiceLife life;
  life.log_amplitude = std::log(tone.amplitude);
  life.decay = tone.damping;
  const double seconds = (life.log_amplitude - std::log(floor)) / life.decay;
  life.length = seconds > 0.0 ? static_cast<std::int64_t>(std::ceil(seconds * sample_rate)) : 0;
  // f0 (1 + 2 c t) = sample_rate / 2
  const double headroom = 0.5 * sample_rate / tone.frequency - 1.0;
  const double fold = headroom / (2.0 * tone.rise) * sample_rate;
  life.fold = fold < 1e15 ? static_cast<std::int64_t>(std::max(fold, 0.0)) : VoiceLife::kNever;
  return life;
}

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
