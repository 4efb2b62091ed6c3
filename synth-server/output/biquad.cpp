// SPDX-License-Identifier: MIT
#include "synth-server/output/biquad.hpp"

#include <cmath>
#include <complex>
#include <numbers>

namespace splash::synth {
namespace {

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

}  // namespace splash::synth
