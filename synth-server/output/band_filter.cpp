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

BandFilter::BandFilter(const Band& band, double sample_rate) {
  sections_[0] = high_pass(band.low, kFirstQ, sample_rate);
  sections_[1] = high_pass(band.low, kSecondQ, sample_rate);
  if (band.high >= 0.45 * sample_rate) return;
  low_pass_ = true;
  sections_[2] = low_pass(band.high, kFirstQ, sample_rate);
  sections_[3] = low_pass(band.high, kSecondQ, sample_rate);
}

bool BandFilter::at_rest(double limit) const noexcept {
  return std::all_of(sections_.begin(), sections_.end(),
                     [limit](const Biquad& section) { return section.at_rest(limit); });
}

}  // namespace splash::synth
