// SPDX-License-Identifier: MIT
// A body meets the water (paper section 5.1): a burst of white noise, its envelope, a resonator.
// Its amplitude grows as speed^exponent. The paper takes 3 (Richardson 1955); he speaks of
// intensity, which read as power would be 1.5: the exponent is therefore a number of the sound.
#pragma once

#include <cmath>
#include <cstdint>

#include "synth-server/voices/noise.hpp"
#include "synth-server/voices/resonator.hpp"
#include "synth-server/voices/sound.hpp"
#include "synth-server/voices/voice_life.hpp"

namespace splash::synth {

// The envelope of paper section 5.1.1: "rises exponentially during an attack time ta, from nil to
// the original amplitude A, followed by an exponential decay of release time tr".
// The paper does not say how far a decay falls in its release time. Here both times are those of
// 60 dB, as reverberation and SuperCollider's Decay count: at ta + tr the envelope is at 1/1000,
// and the attack nears its end as a charging capacitor would, by the factor 1/1000 within ta:
//   e(t) = (1 - 1000^(-t/ta)) / (1 - 1/1000)   for t < ta
//   e(t) = 1000^(-(t - ta)/tr)                 after

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

/// The speed that counts [m/s]: its part `approach` into the water, and as much of what is along
/// the surface as the sound says. Sliding along it transfers almost no momentum.
[[nodiscard]] double impact_speed(const ImpactSound& sound, double speed, double approach) noexcept;

/// A [m], the signal's standard deviation at the envelope's top; `speed` as above [m/s].
[[nodiscard]] double impact_amplitude(const ImpactSound& sound, double speed) noexcept;

class ImpactVoice {
 public:
  ImpactVoice() = default;
  ImpactVoice(const ImpactSound& sound, double amplitude, Noise noise, double sample_rate) noexcept
      : amplitude_(amplitude),
        noise_(noise),
        envelope_(sound, sample_rate),
        resonator_(sound.frequency, sound.q, sample_rate) {}

  /// Writes the next `count` samples [m].
  void render(double* out, int count) noexcept;

 private:
  double amplitude_ = 0.0;
  Noise noise_;
  ImpactEnvelope envelope_;
  Resonator resonator_;
  std::uint64_t next_ = 0;  ///< samples since the start
};

/// `floor` [m]: amplitude under which the voice is over.
[[nodiscard]] VoiceLife impact_life(const ImpactSound& sound, double amplitude, double sample_rate,
                                    double floor) noexcept;

}  // namespace splash::synth
