// SPDX-License-Identifier: MIT
#include "synth-server/voices/bubble_tone.hpp"

#include <algorithm>

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

}  // namespace splash::synth
