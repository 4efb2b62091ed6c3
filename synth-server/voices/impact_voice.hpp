// SPDX-License-Identifier: MIT
// A body meets the water (paper section 5.1): a burst of white noise, its envelope, a resonator.
// Amplitude A = gain speed^exponent. The paper takes 3 (Richardson 1955); he speaks of intensity,
// which read as power would be 1.5: the exponent is therefore a setting.
#pragma once

#include <cstdint>

#include "synth-server/voices/impact_envelope.hpp"
#include "synth-server/voices/noise.hpp"
#include "synth-server/voices/resonator.hpp"
#include "synth-server/voices/voice_life.hpp"

namespace splash::synth {

inline constexpr double kImpactFrequency = 420.0;  ///< w0 [Hz]; paper section 6
/// Sharpness of the resonance [1]: 84 Hz wide, so that it rings for 26 ms (60 dB), well within the
/// release, and the burst keeps the character of noise. The paper gives no value.
inline constexpr double kImpactQ = 5.0;

/// `speed`: its component normal to the water's surface [m/s]; sliding along it transfers almost no
/// momentum. `gain`: A at 1 m/s [m]. A is the signal's standard deviation at the envelope's top.
[[nodiscard]] double impact_amplitude(double speed, double gain, double exponent) noexcept;

class ImpactVoice {
 public:
  ImpactVoice() = default;
  ImpactVoice(double amplitude, Noise noise, double sample_rate) noexcept
      : amplitude_(amplitude),
        noise_(noise),
        envelope_(sample_rate),
        resonator_(kImpactFrequency, kImpactQ, sample_rate) {}

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
[[nodiscard]] VoiceLife impact_life(double amplitude, double sample_rate, double floor) noexcept;

}  // namespace splash::synth
