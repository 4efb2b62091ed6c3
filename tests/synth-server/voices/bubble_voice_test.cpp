// SPDX-License-Identifier: MIT
// The running bubble against the paper's formula, over whole lives; and the two readings of its
// chirp against what they mean for zero crossings.
#include "synth-server/voices/bubble_voice.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <limits>
#include <tuple>
#include <vector>

namespace splash::synth {
namespace {

constexpr double kEpsilon = 0.05;

/// Samples until the bubble has fallen by 120 dB.
std::int64_t whole_life(double radius, double rate, Chirp chirp) {
  return bubble_life(radius, kEpsilon, rate, chirp, kEpsilon * radius * 1e-6).length;
}

/// In blocks of uneven sizes.
std::vector<double> render(double radius, double rate, Chirp chirp, std::int64_t length) {
  BubbleVoice voice(radius, kEpsilon, rate, chirp);
  std::vector<double> out(static_cast<std::size_t>(length));
  constexpr int kBlocks[] = {1, 7, 64, 3, 128, 11, 8};
  std::size_t done = 0;
  for (std::size_t b = 0; done < out.size(); ++b) {
    const std::size_t take =
        std::min(static_cast<std::size_t>(kBlocks[b % std::size(kBlocks)]), out.size() - done);
    voice.render(out.data() + done, static_cast<int>(take));
    done += take;
  }
  return out;
}

class BubbleVoiceError : public testing::TestWithParam<std::tuple<double, double, Chirp>> {};

TEST_P(BubbleVoiceError, IsUnderMinus120DecibelsOverTheWholeLife) {
  const auto [radius, rate, chirp] = GetParam();
  const std::vector<double> out = render(radius, rate, chirp, whole_life(radius, rate, chirp));
  double worst = 0.0;
  for (std::size_t n = 0; n < out.size(); ++n) {
    const double t = static_cast<double>(n) / rate;
    worst = std::max(worst, std::abs(out[n] - bubble_pressure(radius, kEpsilon, t, chirp)));
  }
  const double decibels = 20.0 * std::log10(worst / (kEpsilon * radius));
  std::printf("r = %5.1f mm, %5.0f Hz: %zu samples, largest error %.1f dB\n", radius * 1e3, rate,
              out.size(), decibels);
  RecordProperty("largest_error_db", std::to_string(decibels));
  EXPECT_LT(decibels, -120.0);
  EXPECT_GT(worst, 0.0) << "compared with itself?";
}

INSTANTIATE_TEST_SUITE_P(All, BubbleVoiceError,
                         testing::Combine(testing::Values(0.001, 0.003, 0.005, 0.01, 0.02, 0.05,
                                                          0.1, 0.3),
                                          testing::Values(44100.0, 48000.0, 96000.0),
                                          testing::Values(Chirp::literal, Chirp::integrated)));

TEST(BubbleVoice, KeepsThePapersNumbers) {
  EXPECT_DOUBLE_EQ(bubble_frequency(0.003), 1000.0);
  // notes: 5 mm: d = 26 + 20.365 = 46.365 1/s; T60 = 6.908 / d = 149 ms
  EXPECT_NEAR(bubble_damping(0.005), 46.365, 0.001);
  EXPECT_NEAR(bubble_chirp(0.005, Chirp::literal), 4.6365, 1e-4);
  EXPECT_NEAR(bubble_chirp(0.005, Chirp::integrated), 2.31825, 1e-4);
}

/// A phase of 2 pi f0 (t + c t^2) crosses zero 2 f0 (t + c t^2) times.
int crossings(const std::vector<double>& x, std::size_t from, std::size_t to) {
  int count = 0;
  for (std::size_t n = from + 1; n < to; ++n) count += (x[n - 1] < 0.0) != (x[n] < 0.0) ? 1 : 0;
  return count;
}

/// Instantaneous frequency around time t [Hz], from the crossings of 20 ms.
double pitch(const std::vector<double>& x, double t, double rate) {
  const double half = 0.010;
  const auto from = static_cast<std::size_t>((t - half) * rate);
  const auto to = static_cast<std::size_t>((t + half) * rate);
  return crossings(x, from, to) / (2.0 * 2.0 * half);
}

TEST(BubbleVoice, LiteralChirpRisesTwiceAsFastAsIntegrated) {
  const double radius = 0.004;
  const double rate = 96000.0;
  const double f0 = 750.0;
  const double d = bubble_damping(radius);
  const double t = 0.12;
  const auto literal = render(radius, rate, Chirp::literal, static_cast<std::int64_t>(rate * 0.2));
  const auto integrated =
      render(radius, rate, Chirp::integrated, static_cast<std::int64_t>(rate * 0.2));
  // Over 20 ms at about 1.5 kHz there are 60 crossings: one of them is 25 Hz.
  EXPECT_NEAR(pitch(literal, t, rate), f0 * (1.0 + 0.2 * d * t), 26.0);
  EXPECT_NEAR(pitch(integrated, t, rate), f0 * (1.0 + 0.1 * d * t), 26.0);
}

TEST(BubbleVoice, StartsAtZeroAndDecaysByDamping) {
  const double rate = 48000.0;
  const auto out = render(0.01, rate, Chirp::literal, 48000);
  EXPECT_EQ(out[0], 0.0);
  EXPECT_GT(out[1], 0.0);
  const auto loudest = [&](double t) {  // of one period and more around t
    const auto at = out.begin() + static_cast<std::ptrdiff_t>(t * rate);
    return *std::max_element(at, at + 200);
  };
  const double slope = std::log(loudest(0.1) / loudest(0.3)) / 0.2;
  EXPECT_NEAR(slope, bubble_damping(0.01), 0.03 * bubble_damping(0.01));
}

TEST(BubbleLife, EndsWhereTheAmplitudeMeetsTheFloor) {
  const double rate = 48000.0;
  const VoiceLife life = bubble_life(0.005, kEpsilon, rate, Chirp::literal, 1e-8);
  const double end = static_cast<double>(life.length) / rate;
  EXPECT_NEAR(std::exp(life.log_amplitude_at(end)), 1e-8, 1e-11);
  EXPECT_EQ(bubble_life(0.005, kEpsilon, rate, Chirp::literal, 1.0).length, 0);
}

TEST(BubbleLife, KnowsWhenThePitchReachesNyquist) {
  const double rate = 48000.0;
  // 0.1 mm starts at 30 kHz: over Nyquist from the first sample.
  EXPECT_EQ(bubble_life(0.0001, kEpsilon, rate, Chirp::literal, 1e-12).fold, 0);
  const double radius = 0.00015;  // 20 kHz
  const VoiceLife life = bubble_life(radius, kEpsilon, rate, Chirp::literal, 1e-12);
  const double t = static_cast<double>(life.fold) / rate;
  const double frequency = 20000.0 * (1.0 + 0.2 * bubble_damping(radius) * t);
  EXPECT_NEAR(frequency, 24000.0, 50.0);
  EXPECT_LT(life.fold, life.length);
}

}  // namespace
}  // namespace splash::synth
