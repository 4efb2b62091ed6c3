// SPDX-License-Identifier: MIT
// How quiet a voice may become before nobody feels or hears it, by the threshold curves of touch
// and of hearing and the level that the rig's file gives them.
#pragma once

#include <array>

#include "synth-server/output/rig.hpp"

namespace splash::synth {

/// Threshold of feeling a sine [dB re that at 250 Hz], its strength counted as acceleration: what
/// shakers and tiles give at constant drive. S. J. Bolanowski et al. 1988, J. Acoust. Soc. Am. 84,
/// thenar, large contactor, in displacement within 2 dB, times (2 pi f)^2. Flat beyond 500 Hz.
[[nodiscard]] double touch_threshold_db(double frequency) noexcept;

/// Threshold of hearing a sine in quiet [dB re that at 1 kHz]; E. Terhardt 1979, Hearing Research
/// 1: 3.64 f^-0.8 - 6.5 e^(-0.6 (f - 3.3)^2) + 0.001 f^4 dB SPL with f in kHz.
[[nodiscard]] double hearing_threshold_db(double frequency) noexcept;

/// How far the output's band turns a sine down [dB, positive]: fourth-order Butterworth both ways.
[[nodiscard]] double cut_db(const Band& band, double frequency) noexcept;

/// The least amplitude worth rendering for one output, by the pitch at which a voice begins.
class Audibility {
 public:
  /// Voices end this far below the threshold: a hundred of them together just reach it.
  static constexpr double kMarginDecibels = 20.0;
  /// Where no threshold is known, they end this far below full scale.
  static constexpr double kFloorDecibels = 120.0;

  explicit Audibility(const Output& output, bool by_threshold);

  /// [full scale], for a voice that begins at `frequency` [Hz] and rises from there; 0 Hz: a noise.
  [[nodiscard]] double floor(double frequency) const noexcept;

 private:
  static constexpr double kLowest = 8.0;  ///< [Hz]
  static constexpr std::size_t kPerOctave = 12;
  std::array<double, 12 * kPerOctave> floors_{};  ///< from kLowest on, up to 32 kHz [full scale]
  double least_ = 0.0;                            ///< of them all
};

}  // namespace splash::synth
