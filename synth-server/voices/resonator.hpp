// SPDX-License-Identifier: MIT
// The elementary second-order resonator of paper section 5.1.1: the band-pass of R.
// Bristow-Johnson's Audio EQ Cookbook, H(s) = (s/Q) / (s^2 + s/Q + 1), peak exactly at w0.
// Its gain is set so that white noise keeps its variance: the same loudness at every sample rate.
#pragma once

namespace splash::synth {

class Resonator {
 public:
  Resonator() = default;
  /// `frequency` of the peak [Hz], under half of `sample_rate` [Hz]; bandwidth = frequency / q.
  Resonator(double frequency, double q, double sample_rate) noexcept;

  [[nodiscard]] double process(double in) noexcept {
    const double out = gain_ * in + first_;  // transposed direct form II with b1 = 0, b2 = -b0
    first_ = second_ - a1_ * out;
    second_ = -gain_ * in - a2_ * out;
    return out;
  }

  // Its coefficients, for those that play many side by side.
  [[nodiscard]] double gain() const noexcept { return gain_; }
  [[nodiscard]] double a1() const noexcept { return a1_; }
  [[nodiscard]] double a2() const noexcept { return a2_; }

  /// |H| at `frequency` [Hz].
  [[nodiscard]] double response(double frequency, double sample_rate) const noexcept;

 private:
  double gain_ = 0.0;
  double a1_ = 0.0;
  double a2_ = 0.0;
  double first_ = 0.0;
  double second_ = 0.0;
};

}  // namespace splash::synth
