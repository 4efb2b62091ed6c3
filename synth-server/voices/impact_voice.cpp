// SPDX-License-Identifier: MIT
#include "synth-server/voices/impact_voice.hpp"

#include <cmath>
#include <limits>

namespace splash::synth {

double impact_amplitude(double speed, double gain, double exponent) noexcept {
  return gain * std::pow(speed, exponent);
}

void ImpactVoice::render(double* out, int count) noexcept {
  for (int i = 0; i < count; ++i) {
    out[i] = resonator_.process(amplitude_ * envelope_.next() * noise_.at(next_++));
  }
}

VoiceLife impact_life(double amplitude, double sample_rate, double floor) noexcept {
  VoiceLife life;
  life.log_amplitude = std::log(amplitude);
  life.decay = kFall / kRelease;
  life.hold = kAttack;
  life.fold = std::numeric_limits<std::int64_t>::max();
  const double seconds = (life.log_amplitude - std::log(floor)) / life.decay;
  if (seconds > 0.0) {
    life.length = static_cast<std::int64_t>(std::ceil((kAttack + seconds) * sample_rate));
  }
  return life;
}

}  // namespace splash::synth
