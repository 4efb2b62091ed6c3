// SPDX-License-Identifier: MIT
// The impact: its envelope against the formula, its loudness against speed, its burst against the
// same noise under that envelope through a resonator in closed form.
#include "synth-server/voices/impact_voice.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <numbers>
#include <vector>

namespace splash::synth {
namespace {

constexpr double kRate = 48000.0;
constexpr ImpactSound kPaper;

std::vector<double> burst(double amplitude, std::uint64_t id, int length, int block) {
  ImpactVoice voice({}, amplitude, Noise(1, id), kRate);
  std::vector<double> out(static_cast<std::size_t>(length));
  for (int done = 0; done < length; done += block) {
    voice.render(out.data() + done, std::min(block, length - done));
  }
  return out;
}

void expect_formula(const ImpactSound& sound, double rate, double seconds) {
  ImpactEnvelope envelope(sound, rate);
  double worst = 0.0;
  for (int n = 0; n < static_cast<int>(seconds * rate); ++n) {
    worst = std::max(worst, std::abs(envelope.next() - impact_envelope(sound, n / rate)));
  }
  EXPECT_LT(worst, 1e-12) << rate;
}

TEST(ImpactEnvelope, FollowsItsFormulaAtEveryRate) {
  for (const double rate : {44100.0, 48000.0, 96000.0}) expect_formula({}, rate, 1.0);
}

TEST(ImpactEnvelope, FollowsTheTimesOfItsSound) {
  const ImpactSound slow{.attack = 0.02, .release = 1.0};
  expect_formula(slow, kRate, 2.0);
  EXPECT_NEAR(impact_envelope(slow, 0.02), 1.0, 1e-12);
  EXPECT_NEAR(impact_envelope(slow, 1.02), 0.001, 1e-12);
}

TEST(ImpactEnvelope, RisesFromNilInOneMillisecondAndFalls60DecibelsIn370) {
  EXPECT_EQ(impact_envelope({}, 0.0), 0.0);
  EXPECT_NEAR(impact_envelope({}, 0.001), 1.0, 1e-12);
  EXPECT_NEAR(impact_envelope({}, 0.001 - 1e-9), 1.0, 1e-6);
  EXPECT_NEAR(impact_envelope({}, 0.371), 0.001, 1e-12);
  EXPECT_NEAR(impact_envelope({}, 0.186), std::sqrt(0.001), 1e-12);
}

/// Slope of log amplitude against log speed, of the peaks of rendered bursts.
double slope(double exponent) {
  double sum_xx = 0.0;
  double sum_xy = 0.0;
  const double first = std::log(0.25);
  double first_peak = 0.0;
  for (const double speed : {0.25, 0.5, 1.0, 2.0, 4.0}) {
    const auto out = burst(impact_amplitude({.exponent = exponent}, speed), 3, 4800, 64);
    double peak = 0.0;
    for (const double v : out) peak = std::max(peak, std::abs(v));
    if (first_peak == 0.0) first_peak = std::log(peak);
    const double x = std::log(speed) - first;
    sum_xx += x * x;
    sum_xy += x * (std::log(peak) - first_peak);
  }
  return sum_xy / sum_xx;
}

TEST(ImpactVoice, GrowsWithThePowerOfSpeed) {
  EXPECT_NEAR(slope(3.0), 3.0, 1e-9);
  EXPECT_NEAR(slope(1.5), 1.5, 1e-9);
  EXPECT_DOUBLE_EQ(impact_amplitude({}, 1.0), 5e-4);
  EXPECT_DOUBLE_EQ(impact_amplitude({}, 2.0), 4e-3);
}

TEST(ImpactVoice, CountsAsMuchOfTheSlidingAsItsSoundSays) {
  EXPECT_EQ(impact_speed({}, 5.0, 3.0), 3.0) << "none";
  EXPECT_DOUBLE_EQ(impact_speed({.sliding = 1.0}, 5.0, 3.0), 5.0) << "all";
  EXPECT_DOUBLE_EQ(impact_speed({.sliding = 0.5}, 5.0, 3.0), std::sqrt(13.0));
  EXPECT_EQ(impact_speed({.sliding = 1.0}, 0.0, 3.0), 3.0) << "of a sender that tells no speed";
}

TEST(ImpactVoice, IsTheSameInAllBlocks) {
  const auto whole = burst(1.0, 9, 20000, 20000);
  EXPECT_EQ(burst(1.0, 9, 20000, 1), whole);
  EXPECT_EQ(burst(1.0, 9, 20000, 37), whole);
  EXPECT_NE(burst(1.0, 10, 20000, 37), whole);
}

/// Impulse response of the band-pass (w0, Q) of unit noise gain in closed form, from its poles
/// rho e^(+-i theta): h(n) = g (c(n) - c(n - 2)) with c(n) = rho^n sin((n + 1) theta) / sin theta.
std::vector<double> closed_form_response(double rate, std::size_t length) {
  const double w = 2.0 * std::numbers::pi * kPaper.frequency / rate;
  const double alpha = std::sin(w) / (2.0 * kPaper.q);
  const double rho = std::sqrt((1.0 - alpha) / (1.0 + alpha));
  const double theta = std::acos(std::cos(w) / (1.0 + alpha) / rho);
  const auto c = [&](double n) {
    return n < 0.0 ? 0.0 : std::pow(rho, n) * std::sin((n + 1.0) * theta) / std::sin(theta);
  };
  std::vector<double> h;
  for (std::size_t n = 0; n < length; ++n) {
    const auto at = static_cast<double>(n);
    h.push_back(std::sqrt((1.0 - rho * rho) / 2.0) * (c(at) - c(at - 2.0)));
  }
  return h;
}

class ImpactVoiceAt : public testing::TestWithParam<double> {};
INSTANTIATE_TEST_SUITE_P(Rates, ImpactVoiceAt, testing::Values(44100.0, 48000.0, 96000.0));

TEST_P(ImpactVoiceAt, IsTheNoiseUnderItsEnvelopeThroughItsResonatorOverItsWholeLife) {
  const double rate = GetParam();
  const Noise noise(7, 11);
  ImpactVoice voice({}, 1.0, noise, rate);
  std::vector<double> out(static_cast<std::size_t>(impact_life({}, 1.0, rate, 1e-6).length));
  voice.render(out.data(), static_cast<int>(out.size()));
  std::vector<double> excitation;
  for (std::size_t n = 0; n < out.size(); ++n) {
    excitation.push_back(impact_envelope({}, static_cast<double>(n) / rate) * noise.at(n));
  }
  const auto h = closed_form_response(rate, static_cast<std::size_t>(rate / 12));  // to -190 dB
  double worst = 0.0;
  // Every 7th sample: all the life, a seventh of the work.
  for (std::size_t n = 0; n < out.size(); n += 7) {
    double expected = 0.0;
    for (std::size_t k = 0; k < h.size() && k <= n; ++k) expected += h[k] * excitation[n - k];
    worst = std::max(worst, std::abs(out[n] - expected));
  }
  std::printf("%.0f Hz: largest error %.1f dB\n", rate, 20.0 * std::log10(worst));
  EXPECT_LT(20.0 * std::log10(worst), -140.0);
  EXPECT_GT(worst, 0.0) << "compared with itself?";
}

TEST(ImpactLife, EndsWhereTheEnvelopeMeetsTheFloor) {
  const VoiceLife life = impact_life({}, 1e-3, kRate, 1e-8);
  const double end = static_cast<double>(life.length) / kRate;
  EXPECT_NEAR(1e-3 * impact_envelope({}, end), 1e-8, 1e-11);
  EXPECT_NEAR(std::exp(life.log_amplitude - life.decay * (end - life.hold)), 1e-8, 1e-11);
  const auto out = burst(1e-3, 5, static_cast<int>(life.length), 64);
  EXPECT_LT(std::abs(out.back()), 1e-7);
  EXPECT_EQ(impact_life({}, 0.0, kRate, 1e-8).length, 0) << "an impact without speed is none";
}

}  // namespace
}  // namespace splash::synth
