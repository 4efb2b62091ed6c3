// SPDX-License-Identifier: MIT
#include "synth-server/voices/resonator.hpp"

#include <cmath>
#include <complex>
#include <numbers>

namespace splash::synth {

Resonator::Resonator(double frequency, double q, double sample_rate) noexcept {
  const double w = 2.0 * std::numbers::pi * frequency / sample_rate;
  const double alpha = std::sin(w) / (2.0 * q);
  a1_ = -2.0 * std::cos(w) / (1.0 + alpha);
  a2_ = (1.0 - alpha) / (1.0 + alpha);
  // With gain (1 - a2)/2 the peak is 1, and H = (1 - A)/2 with the all-pass A whose first sample is
  // a2: the sum of h^2 is (1 - a2)/2. Its root more makes that sum 1.
  gain_ = std::sqrt((1.0 - a2_) / 2.0);
}

double Resonator::response(double frequency, double sample_rate) const noexcept {
  const std::complex<double> z = std::polar(1.0, -2.0 * std::numbers::pi * frequency / sample_rate);
  return std::abs(gain_ * (1.0 - z * z) / (1.0 + a1_ * z + a2_ * z * z));
}

}  // namespace splash::synth
