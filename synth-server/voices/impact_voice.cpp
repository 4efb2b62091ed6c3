// SPDX-License-Identifier: MIT
#include "synth-server/voices/impact_voice.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

namespace splash::synth {

double impact_speed(const ImpactSound& sound, double speed, double approach) noexcept {
  const double along = std::sqrt(std::max(0.0, speed * speed - approach * approach));
  return std::hypot(approach, sound.sliding * along);
}

double impact_amplitude(const ImpactSound& sound, double speed) noexcept {
  return sound.amplitude * std::pow(speed, sound.exponent);
}

void ImpactVoice::render(double* out, int count) noexcept {
  for (int i = 0; i < count; ++i) {
    out[i] = resonator_.process(amplitude_ * envelope_.next() * noise_.at(next_++));
  }
}

VoiceLife impact_life(const ImpactSound& sound, double amplitude, double sample_rate,
                      double floor) noexcept {
  VoiceLife life;
  life.log_amplitude = std::log(amplitude);
  life.decay = kFall / sound.release;
  life.hold = sound.attack;
  life.fold = std::numeric_limits<std::int64_t>::max();
  const double seconds = (life.log_amplitude - std::log(floor)) / life.decay;
  if (seconds > 0.0) {
    life.length = static_cast<std::int64_t>(std::ceil((sound.attack + seconds) * sample_rate));
  }
  return life;
}

}  // namespace splash::synth
