// SPDX-License-Identifier: MIT
// One second-order section, and how to draw one: R. Bristow-Johnson, "Audio EQ Cookbook" (bilinear
// transform, pre-warped at the frequency named). All are stable for 0 < frequency < Nyquist, q > 0.
// Four of them keep a channel within its band.
#pragma once

#include <array>

#include "synth-server/output/rig.hpp"

namespace splash::synth {

/// Transposed direct form II, in double precision.
struct Biquad {
  double b0 = 1.0;
  double b1 = 0.0;
  double b2 = 0.0;
  double a1 = 0.0;
  double a2 = 0.0;
  double first = 0.0;   ///< state
  double second = 0.0;  ///< state

  [[nodiscard]] double process(double in) noexcept {
    const double out = b0 * in + first;
    first = b1 * in - a1 * out + second;
    second = b2 * in - a2 * out;
    return out;
  }
  void reset() noexcept { first = second = 0.0; }
  /// Whether no state exceeds `limit`.
  [[nodiscard]] bool at_rest(double limit) const noexcept {
    return first <= limit && first >= -limit && second <= limit && second >= -limit;
  }
};

/// `frequency`: -3 dB for q = 1 / sqrt 2 [Hz].
[[nodiscard]] Biquad high_pass(double frequency, double q, double sample_rate);
[[nodiscard]] Biquad low_pass(double frequency, double q, double sample_rate);
/// `gain_db` at `frequency`, 0 dB far from it; q: frequency over the width at half of gain_db.
[[nodiscard]] Biquad peak(double frequency, double gain_db, double q, double sample_rate);
/// `gain_db` below (above) `frequency`, half of it there.
[[nodiscard]] Biquad low_shelf(double frequency, double gain_db, double q, double sample_rate);
[[nodiscard]] Biquad high_shelf(double frequency, double gain_db, double q, double sample_rate);

/// |H| at `frequency` [Hz].
[[nodiscard]] double magnitude(const Biquad& section, double frequency, double sample_rate);

/// A transducer's band: fourth-order Butterworth high-pass and low-pass,
/// 24 dB per octave, -3 dB at both ends. Four biquads in double precision.
class BandFilter {
 public:
  BandFilter() = default;
  /// A low-pass at or above 0.45 of `sample_rate` [Hz] is left out: nothing would be cut.
  BandFilter(const Band& band, double sample_rate);

  [[nodiscard]] double process(double in) noexcept {
    in = sections_[1].process(sections_[0].process(in));
    return low_pass_ ? sections_[3].process(sections_[2].process(in)) : in;
  }

  void reset() noexcept {
    for (Biquad& section : sections_) section.reset();
  }
  /// Whether no state exceeds `limit`.
  [[nodiscard]] bool at_rest(double limit) const noexcept;

 private:
  std::array<Biquad, 4> sections_{};  ///< two of the high-pass, two of the low-pass
  bool low_pass_ = false;
};

}  // namespace splash::synth
