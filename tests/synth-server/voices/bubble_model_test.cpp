// SPDX-License-Identifier: MIT
// The two models of a bubble against tables that were computed apart from this code, and the two
// readings of the paper's chirp against what they mean for zero crossings.
#include "synth-server/voices/bubble_tone.hpp"

#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <limits>
#include <vector>

#include "synth-server/voices/physical_bubble.hpp"

namespace splash::synth {
namespace {

/// An air bubble in water of 20 C at 101325 Pa. First the paper's fit, then linear theory with the
/// complex polytropic function (Prosperetti 1977; rho 998, c 1482, mu 1e-3, sigma 0.0728, heat's
/// diffusivity 2.0e-5, gamma 1.4), then the same with gamma instead of k: Minnaert's frequency.
struct Row {
  double radius_mm, paper_frequency, minnaert, frequency, polytropic;
  double paper_damping, damping, viscous, thermal, radiation;
};
constexpr ToneSound kIntegrated{.rise = kIntegratedRise};
constexpr ToneSound kPhysical{.rise = kIntegratedRise, .physical = 1.0};
constexpr std::array kTable = {
    Row{0.15, 20000, 21910.2, 21229.3, 1.3050, 4785.85, 4820.45, 89.07, 3831, 900.41},
    Row{0.3, 10000, 10955.1, 10706.8, 1.3325, 1818.97, 1919.03, 22.27, 1438.7, 458.06},
    Row{0.5, 6000, 6573.06, 6455.85, 1.3476, 903.988, 976.327, 8.016, 690.75, 277.56},
    Row{1, 3000, 3286.53, 3244.48, 1.3629, 357.684, 394.5, 2.004, 252.29, 140.21},
    Row{2, 1500, 1643.27, 1628.25, 1.3738, 145.498, 162.385, 0.501, 91.26, 70.624},
    Row{3, 1000, 1095.51, 1087.3, 1.3786, 87.1511, 97.6418, 0.2227, 50.18, 47.239},
    Row{5, 600, 657.306, 653.476, 1.3834, 46.3647, 52.0772, 0.08016, 23.558, 28.439},
    Row{10, 300, 328.653, 327.294, 1.3883, 20.2, 22.7019, 0.02004, 8.4141, 14.268},
    Row{15, 200, 219.102, 218.361, 1.3904, 12.5859, 14.1358, 0.008907, 4.6006, 9.5262},
    Row{20, 150, 164.327, 163.845, 1.3917, 9.04558, 10.1524, 0.00501, 2.9962, 7.1511},
    Row{30, 100, 109.551, 109.288, 1.3932, 5.71897, 6.41089, 0.002227, 1.6361, 4.7726},
    Row{50, 60, 65.7306, 65.6084, 1.3948, 3.24399, 3.63024, 0.0008016, 0.76282, 2.8666},
    Row{100, 30, 32.8653, 32.822, 1.3963, 1.52768, 1.70563, 0.0002004, 0.27056, 1.4349},
    Row{150, 20, 21.9102, 21.8866, 1.3970, 0.990602, 1.10461, 8.907e-05, 0.14748, 0.95704}};

/// Within the digits of the table.
void expect_digits(double value, double expected) {
  EXPECT_NEAR(value, expected, 6e-5 * expected);
}

TEST(PaperBubble, MatchesTheTable) {
  for (const Row& row : kTable) {
    const BubbleTone tone = paper_bubble(row.radius_mm * 1e-3, 0.05);
    expect_digits(tone.frequency, row.paper_frequency);
    expect_digits(tone.damping, row.paper_damping);
    EXPECT_DOUBLE_EQ(tone.rise, 0.1 * tone.damping);
    EXPECT_DOUBLE_EQ(tone.amplitude, 0.05 * row.radius_mm * 1e-3);
    EXPECT_DOUBLE_EQ(paper_bubble(row.radius_mm * 1e-3, 0.05, kIntegrated).rise,
                     0.05 * tone.damping);
  }
}

TEST(PhysicalBubble, MatchesTheTable) {
  for (const Row& row : kTable) {
    SCOPED_TRACE(row.radius_mm);
    const BubbleResonance found = resonance(row.radius_mm * 1e-3, 0.0);
    expect_digits(found.frequency, row.frequency);
    EXPECT_NEAR(found.polytropic, row.polytropic, 6e-5);
    EXPECT_NEAR(found.viscous, row.viscous, 2e-4 * row.viscous);
    EXPECT_NEAR(found.thermal, row.thermal, 2e-4 * row.thermal);
    expect_digits(found.radiation, row.radiation);
    expect_digits(found.damping(), row.damping);
    const BubbleTone tone = bubble_tone(kPhysical, row.radius_mm * 1e-3, 0.05, 0.0);
    EXPECT_DOUBLE_EQ(tone.frequency, found.frequency);
    EXPECT_DOUBLE_EQ(tone.damping, found.damping());
    EXPECT_DOUBLE_EQ(tone.rise, 0.05 * tone.damping) << "its phase is the integral of f";
  }
}

TEST(PhysicalBubble, IsMinnaertsWhereHeatAndTensionDoNotMatter) {
  for (const Row& row : kTable) {
    Water water;
    water.surface_tension = 0.0;
    water.gas_diffusivity = 1e-12;
    const double radius = row.radius_mm * 1e-3;
    const BubbleResonance found = resonance(radius, 0.0, water);
    expect_digits(found.frequency,
                  std::sqrt(3.0 * 1.4 * 101325.0 / 998.0) / (2.0 * std::numbers::pi * radius));
    EXPECT_NEAR(found.frequency, row.minnaert, 0.002 * row.minnaert) << "the table has tension";
    EXPECT_LT(found.thermal, 1e-3 * row.thermal);
  }
}

TEST(PhysicalBubble, RisesWithTheRootOfThePressure) {
  // 10.33 m of water weigh one atmosphere: a bubble of 1 cm sounds sqrt 2 times as high there.
  const double atmosphere = 101325.0 / (998.0 * 9.81);
  const double ratio = resonance(0.01, atmosphere).frequency / resonance(0.01, 0.0).frequency;
  EXPECT_NEAR(ratio, std::sqrt(2.0), 0.002);
  EXPECT_DOUBLE_EQ(bubble_tone(kPhysical, 0.01, 0.05, atmosphere).frequency,
                   resonance(0.01, atmosphere).frequency);
}

TEST(BubbleModel, IsThePapersToTheBitUnlessItsSoundSaysOtherwise) {
  for (const Row& row : kTable) {
    const double r = row.radius_mm * 1e-3;
    const BubbleTone paper = paper_bubble(r, 0.037, {});
    const BubbleTone tone = bubble_tone({}, r, 0.037, 0.3);
    EXPECT_EQ(tone.amplitude, paper.amplitude);
    EXPECT_EQ(tone.frequency, 3.0 / r);
    EXPECT_EQ(tone.damping, paper.damping);
    EXPECT_EQ(tone.rise, 0.1 * paper.damping);
  }
}

// Each number of the sound does what its row says, and nothing else.
TEST(BubbleModel, FollowsEachNumberOfItsSound) {
  constexpr double kRadius = 0.004;
  const BubbleTone paper = bubble_tone({}, kRadius, 0.04, 0.0);
  const auto expect = [&](const ToneSound& sound, double amplitude, double pitch, double damping,
                          double rise) {
    const BubbleTone tone = bubble_tone(sound, kRadius, 0.04, 0.0);
    EXPECT_NEAR(tone.amplitude / paper.amplitude, amplitude, 1e-12);
    EXPECT_NEAR(tone.frequency / paper.frequency, pitch, 1e-12);
    EXPECT_NEAR(tone.damping / paper.damping, damping, 1e-12);
    EXPECT_NEAR(tone.rise / paper.rise, rise, 1e-12);
  };
  expect({.minnaert = 3.3}, 1.0, 1.1, 1.0, 1.0);
  expect({.pitch = 0.25}, 1.0, 0.25, 1.0, 1.0);
  expect({.damping = 2.0}, 1.0, 1.0, 2.0, 2.0);
  expect({.rise = 0.3}, 1.0, 1.0, 1.0, 3.0);
  expect({.excitation = 0.5}, 1.0 / std::sqrt(0.04), 1.0, 1.0, 1.0);
  const double linear = 0.13 / kRadius / paper.damping;
  expect({.radiation = 0.26}, 1.0, 1.0, 1.0 + linear, 1.0 + linear);
  expect({.thermal = 0.0144}, 1.0, 1.0, 2.0 - linear, 2.0 - linear);
  const BubbleResonance found = resonance(kRadius, 0.0);
  const double pitch = std::sqrt(found.frequency / paper.frequency);
  const double damping = std::sqrt(found.damping() / paper.damping);
  expect({.physical = 0.5}, 1.0, pitch, damping, damping);
}

/// Instantaneous frequency of a tone around time t [Hz], from the zero crossings of 20 ms.
double pitch(const BubbleTone& tone, double t) {
  constexpr double kRate = 96000.0;
  constexpr double kHalf = 0.010;
  int crossings = 0;
  double before = pressure(tone, t - kHalf);
  for (int n = 1; n < static_cast<int>(2.0 * kHalf * kRate); ++n) {
    const double now = pressure(tone, t - kHalf + n / kRate);
    crossings += (before < 0.0) != (now < 0.0) ? 1 : 0;
    before = now;
  }
  return crossings / (2.0 * 2.0 * kHalf);
}

TEST(Chirp, RisesTwiceAsFastLiterallyAsIntegrated) {
  const double d = paper_damping(0.004);
  const double t = 0.12;
  // Over 20 ms at about 1.5 kHz there are 60 crossings: one of them is 25 Hz.
  EXPECT_NEAR(pitch(paper_bubble(0.004, 1.0), t), 750.0 * (1.0 + 0.2 * d * t), 26.0);
  EXPECT_NEAR(pitch(paper_bubble(0.004, 1.0, kIntegrated), t), 750.0 * (1.0 + 0.1 * d * t), 26.0);
}

TEST(Pressure, StartsAtNilAndDecaysByTheDamping) {
  const BubbleTone tone = paper_bubble(0.01, 0.05);
  EXPECT_EQ(pressure(tone, 0.0), 0.0);
  EXPECT_GT(pressure(tone, 1e-4), 0.0);
  double most = 0.0;
  for (double t = 0.2; t < 0.21; t += 1e-5) {
    most = std::max(most, std::abs(pressure(tone, t)) * std::exp(tone.damping * t));
  }
  EXPECT_NEAR(most, tone.amplitude, 1e-3 * tone.amplitude);
}

TEST(BubbleLife, EndsWhereTheAmplitudeMeetsTheFloor) {
  const double rate = 48000.0;
  const BubbleTone tone = paper_bubble(0.005, 0.05);
  const VoiceLife life = life_of(tone, rate, 1e-8);
  const double end = static_cast<double>(life.length) / rate;
  EXPECT_NEAR(std::exp(life.log_amplitude - life.decay * end), 1e-8, 1e-11);
  EXPECT_EQ(life_of(tone, rate, 1.0).length, 0);
}

TEST(BubbleLife, KnowsWhenThePitchReachesNyquist) {
  const double rate = 48000.0;
  // 0.1 mm starts at 30 kHz: over Nyquist from the first sample.
  EXPECT_EQ(life_of(paper_bubble(0.0001, 0.05), rate, 1e-12).fold, 0);
  const BubbleTone tone = paper_bubble(0.00015, 0.05);  // 20 kHz
  const VoiceLife life = life_of(tone, rate, 1e-12);
  const double t = static_cast<double>(life.fold) / rate;
  EXPECT_NEAR(20000.0 * (1.0 + 0.2 * tone.damping * t), 24000.0, 50.0);
  EXPECT_LT(life.fold, life.length);
}

}  // namespace
}  // namespace splash::synth
