// SPDX-License-Identifier: MIT
// The envelope of paper section 5.1.1: "rises exponentially during an attack time ta, from nil to
// the original amplitude A, followed by an exponential decay of release time tr".
// The paper does not say how far a decay falls in its release time. Here both times are those of
// 60 dB, as reverberation and SuperCollider's Decay count: at ta + tr the envelope is at 1/1000,
// and the attack nears its end as a charging capacitor would, by the factor 1/1000 within ta:
//   e(t) = (1 - 1000^(-t/ta)) / (1 - 1/1000)   for t < ta
//   e(t) = 1000^(-(t - ta)/tr)                 after
#pragma once

#include <cmath>

#include "synth-server/voices/sound.hpp"

namespace splash::synth {

inline constexpr double kFall = 6.907755278982137;  ///< ln 1000: 60 dB

/// The formula: what the running envelope is tested against. `t` from the start [s].
[[nodiscard]] inline double impact_envelope(const ImpactSound& sound, double t) noexcept {
  const double attack = sound.attack;
  if (t < attack) return (1.0 - std::exp(-kFall * t / attack)) / (1.0 - std::exp(-kFall));
  return std::exp(-kFall * (t - attack) / sound.release);
}

/// The same, sample after sample.
class ImpactEnvelope {
 public:
  ImpactEnvelope() = default;
  ImpactEnvelope(const ImpactSound& sound, double sample_rate) noexcept
      : attack_left_(static_cast<int>(std::ceil(sound.attack * sample_rate))),
        attack_factor_(std::exp(-kFall / (sound.attack * sample_rate))),
        release_factor_(std::exp(-kFall / (sound.release * sample_rate))),
        release_(impact_envelope(sound, attack_left_ / sample_rate)) {}

  [[nodiscard]] double next() noexcept {
    if (attack_left_ > 0) {
      --attack_left_;
      const double value = (1.0 - missing_) / (1.0 - std::exp(-kFall));
      missing_ *= attack_factor_;
      return value;
    }
    const double value = release_;
    release_ *= release_factor_;
    return value;
  }

 private:
  int attack_left_ = 0;          ///< samples
  double attack_factor_ = 0.0;   ///< per sample
  double release_factor_ = 0.0;  ///< per sample
  double release_ = 0.0;
  double missing_ = 1.0;  ///< what the attack lacks to its asymptote
};

}  // namespace splash::synth
