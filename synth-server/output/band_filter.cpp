// SPDX-License-Identifier: MIT
#include "synth-server/output/band_filter.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace splash::synth {
namespace {

/// Sharpnesses of the two biquads of a fourth-order Butterworth filter: 1 / (2 cos(k pi / 8)).
const double kFirstQ = 0.5 / std::cos(std::numbers::pi / 8.0);
const double kSecondQ = 0.5 / std::cos(3.0 * std::numbers::pi / 8.0);

}  // namespace

// Both after R. Bristow-Johnson, Audio EQ Cookbook (bilinear, pre-warped at `frequency`).
BandFilter::Section BandFilter::high_pass(double frequency, double q, double sample_rate) {
  const double w = 2.0 * std::numbers::pi * frequency / sample_rate;
  const double alpha = std::sin(w) / (2.0 * q);
  const double b = (1.0 + std::cos(w)) / 2.0 / (1.0 + alpha);
  return {b, -2.0 * b, b, -2.0 * std::cos(w) / (1.0 + alpha), (1.0 - alpha) / (1.0 + alpha)};
}

BandFilter::Section BandFilter::low_pass(double frequency, double q, double sample_rate) {
  const double w = 2.0 * std::numbers::pi * frequency / sample_rate;
  const double alpha = std::sin(w) / (2.0 * q);
  const double b = (1.0 - std::cos(w)) / 2.0 / (1.0 + alpha);
  return {b, 2.0 * b, b, -2.0 * std::cos(w) / (1.0 + alpha), (1.0 - alpha) / (1.0 + alpha)};
}

BandFilter::BandFilter(const Band& band, double sample_rate) {
  sections_[0] = high_pass(band.low, kFirstQ, sample_rate);
  sections_[1] = high_pass(band.low, kSecondQ, sample_rate);
  if (band.high >= 0.45 * sample_rate) return;
  sections_[2] = low_pass(band.high, kFirstQ, sample_rate);
  sections_[3] = low_pass(band.high, kSecondQ, sample_rate);
}

void BandFilter::reset() noexcept {
  for (Section& s : sections_) s.first = s.second = 0.0;
}

bool BandFilter::at_rest(double limit) const noexcept {
  return std::all_of(sections_.begin(), sections_.end(), [limit](const Section& s) {
    return std::abs(s.first) <= limit && std::abs(s.second) <= limit;
  });
}

}  // namespace splash::synth
