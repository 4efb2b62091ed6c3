// SPDX-License-Identifier: MIT
#include "synth-server/output/biquad.hpp"

#include <algorithm>
#include <cmath>
#include <complex>
#include <numbers>

namespace splash::synth {
namespace {

/// Sharpnesses of the two biquads of a fourth-order Butterworth filter: 1 / (2 cos(k pi / 8)).
const double kFirstQ = 0.5 / std::cos(std::numbers::pi / 8.0);
const double kSecondQ = 0.5 / std::cos(3.0 * std::numbers::pi / 8.0);

/// The cookbook's intermediate values.
struct Draft {
  Draft(double frequency, double q, double sample_rate)
      : angle(2.0 * std::numbers::pi * frequency / sample_rate),
        cosine(std::cos(angle)),
        alpha(std::sin(angle) / (2.0 * q)) {}
  double angle;
  double cosine;
  double alpha;
};

/// A = 10^(dB / 40): the gain's square root.
double root_gain(double gain_db) {
  return std::pow(10.0, gain_db / 40.0);
}

Biquad normalised(double b0, double b1, double b2, double a0, double a1, double a2) {
  return {b0 / a0, b1 / a0, b2 / a0, a1 / a0, a2 / a0};
}

/// Both shelves: they differ in the signs of the terms with the cosine.
Biquad shelf(const Draft& d, double gain_db, double side) {
  const double a = root_gain(gain_db);
  const double c = side * d.cosine;
  const double slope = 2.0 * std::sqrt(a) * d.alpha;
  return normalised(a * ((a + 1.0) - (a - 1.0) * c + slope),
                    side * 2.0 * a * ((a - 1.0) - (a + 1.0) * c),
                    a * ((a + 1.0) - (a - 1.0) * c - slope), (a + 1.0) + (a - 1.0) * c + slope,
                    side * -2.0 * ((a - 1.0) + (a + 1.0) * c), (a + 1.0) + (a - 1.0) * c - slope);
}

}  // namespace

Biquad high_pass(double frequency, double q, double sample_rate) {
  const Draft d(frequency, q, sample_rate);
  const double b = (1.0 + d.cosine) / 2.0 / (1.0 + d.alpha);
  return {b, -2.0 * b, b, -2.0 * d.cosine / (1.0 + d.alpha), (1.0 - d.alpha) / (1.0 + d.alpha)};
}

Biquad low_pass(double frequency, double q, double sample_rate) {
  const Draft d(frequency, q, sample_rate);
  const double b = (1.0 - d.cosine) / 2.0 / (1.0 + d.alpha);
  return {b, 2.0 * b, b, -2.0 * d.cosine / (1.0 + d.alpha), (1.0 - d.alpha) / (1.0 + d.alpha)};
}

Biquad peak(double frequency, double gain_db, double q, double sample_rate) {
  const Draft d(frequency, q, sample_rate);
  const double a = root_gain(gain_db);
  return normalised(1.0 + d.alpha * a, -2.0 * d.cosine, 1.0 - d.alpha * a, 1.0 + d.alpha / a,
                    -2.0 * d.cosine, 1.0 - d.alpha / a);
}

Biquad low_shelf(double frequency, double gain_db, double q, double sample_rate) {
  return shelf(Draft(frequency, q, sample_rate), gain_db, 1.0);
}

Biquad high_shelf(double frequency, double gain_db, double q, double sample_rate) {
  return shelf(Draft(frequency, q, sample_rate), gain_db, -1.0);
}

double magnitude(const Biquad& s, double frequency, double sample_rate) {
  const double angle = 2.0 * std::numbers::pi * frequency / sample_rate;
  const std::complex<double> z = std::polar(1.0, -angle);  // one sample's delay
  return std::abs((s.b0 + z * (s.b1 + z * s.b2)) / (1.0 + z * (s.a1 + z * s.a2)));
}

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
