// SPDX-License-Identifier: MIT
// The resonator's response, measured from its impulse response, against the analog prototype.
#include "synth-server/voices/resonator.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <complex>
#include <numbers>
#include <vector>

namespace splash::synth {
namespace {

constexpr double kFrequency = 420.0;
constexpr double kQ = 5.0;

std::vector<double> impulse_response(double rate) {
  Resonator resonator(kFrequency, kQ, rate);
  std::vector<double> h(static_cast<std::size_t>(rate / 4));
  for (std::size_t n = 0; n < h.size(); ++n) h[n] = resonator.process(n == 0 ? 1.0 : 0.0);
  return h;
}

double measured(const std::vector<double>& h, double frequency, double rate) {
  std::complex<double> sum = 0.0;
  for (std::size_t n = 0; n < h.size(); ++n) {
    sum +=
        h[n] * std::polar(1.0, -2.0 * std::numbers::pi * frequency * static_cast<double>(n) / rate);
  }
  return std::abs(sum);
}

/// |H| of (s/Q) / (s^2 + s/Q + 1), with the bilinear transform's frequency warping.
double prototype(double frequency, double rate) {
  const double w = std::tan(std::numbers::pi * frequency / rate) /
                   std::tan(std::numbers::pi * kFrequency / rate);
  const std::complex<double> s(0.0, w);
  return std::abs(s / kQ / (s * s + s / kQ + 1.0));
}

class ResonatorAt : public testing::TestWithParam<double> {};
INSTANTIATE_TEST_SUITE_P(Rates, ResonatorAt, testing::Values(44100.0, 48000.0, 96000.0));

TEST_P(ResonatorAt, MatchesThePrototypeFromTenHertzToTenKilohertz) {
  const double rate = GetParam();
  const auto h = impulse_response(rate);
  const double peak = measured(h, kFrequency, rate);
  for (const double f :
       {10.0, 60.0, 200.0, 378.0, 400.0, 419.0, 421.0, 450.0, 700.0, 2000.0, 1e4}) {
    EXPECT_NEAR(measured(h, f, rate) / peak / prototype(f, rate), 1.0, 1e-3) << f << " Hz";
    EXPECT_NEAR(Resonator(kFrequency, kQ, rate).response(f, rate), measured(h, f, rate), 1e-6);
  }
}

TEST_P(ResonatorAt, PeaksAtItsFrequencyAndIsAsWideAsItsQSays) {
  const double rate = GetParam();
  const Resonator resonator(kFrequency, kQ, rate);
  const double peak = resonator.response(kFrequency, rate);
  EXPECT_LT(resonator.response(kFrequency - 1.0, rate), peak);
  EXPECT_LT(resonator.response(kFrequency + 1.0, rate), peak);
  double low = kFrequency;
  double high = kFrequency;
  while (resonator.response(low, rate) > peak * std::numbers::sqrt2 / 2.0) low -= 0.01;
  while (resonator.response(high, rate) > peak * std::numbers::sqrt2 / 2.0) high += 0.01;
  EXPECT_NEAR(high - low, kFrequency / kQ, 0.2);
}

TEST_P(ResonatorAt, KeepsTheVarianceOfWhiteNoise) {
  double energy = 0.0;
  for (const double v : impulse_response(GetParam())) energy += v * v;
  EXPECT_NEAR(energy, 1.0, 1e-9);
}

}  // namespace
}  // namespace splash::synth
