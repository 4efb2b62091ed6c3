// SPDX-License-Identifier: MIT
// A body meets the water (paper section 5.1): a burst of white noise, its envelope, a resonator.
// Its amplitude grows as speed^exponent. The paper takes 3 (Richardson 1955); he speaks of
// intensity, which read as power would be 1.5: the exponent is therefore a number of the sound.
#pragma once

#include <cstdint>

#include "synth-server/voices/impact_envelope.hpp"
#include "synth-server/voices/noise.hpp"
#include "synth-server/voices/resonator.hpp"
#include "synth-server/voices/voice_life.hpp"

namespace splash::synth {

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
