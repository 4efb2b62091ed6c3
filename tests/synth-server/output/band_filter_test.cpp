// SPDX-License-Identifier: MIT
// What a band lets through, measured with sines: -3 dB at its ends, 24 dB per octave outside.
#include "synth-server/output/biquad.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

namespace splash::synth {
namespace {

constexpr double kRate = 48000.0;

/// Gain of a steady sine [dB]: by correlation over whole periods, after settling.
double gain_db(const Band& band, double frequency) {
  BandFilter filter(band, kRate);
  const auto settle = static_cast<int>(kRate);  // 1 s
  const auto measure = static_cast<int>(std::llround(20.0 / frequency * kRate));
  double sine = 0.0;
  double cosine = 0.0;
  for (int n = 0; n < settle + measure; ++n) {
    const double phase = 2.0 * std::numbers::pi * frequency * n / kRate;
    const double out = filter.process(std::sin(phase));
    if (n < settle) continue;
    sine += out * std::sin(phase);
    cosine += out * std::cos(phase);
  }
  return 20.0 * std::log10(2.0 * std::hypot(sine, cosine) / measure);
}

TEST(BandFilter, OfTheFloorKeepsTwentyTo750Hertz) {
  const Band band{20.0, 750.0};
  EXPECT_NEAR(gain_db(band, 20.0), -3.01, 0.05);
  EXPECT_NEAR(gain_db(band, 750.0), -3.01, 0.05);
  for (const double f : {40.0, 60.0, 120.0, 250.0, 375.0}) {
    EXPECT_NEAR(gain_db(band, f), 0.0, 0.05) << f;
  }
  EXPECT_NEAR(gain_db(band, 10.0), -24.1, 0.2);
  EXPECT_NEAR(gain_db(band, 5.0), -48.2, 0.3);
  EXPECT_NEAR(gain_db(band, 1500.0), -24.1, 0.2);
  EXPECT_NEAR(gain_db(band, 3000.0), -48.5, 0.5);
}

TEST(BandFilter, OfLoudspeakersKeepsTwelveToTwentyThousandHertz) {
  const Band band{12.0, 20000.0};
  EXPECT_NEAR(gain_db(band, 12.0), -3.01, 0.05);
  EXPECT_NEAR(gain_db(band, 1000.0), 0.0, 0.01);
  EXPECT_NEAR(gain_db(band, 20000.0), -3.01, 0.05);
}

TEST(BandFilter, LeavesOutALowPassThatNyquistMakesNeedless) {
  EXPECT_NEAR(gain_db({12.0, 23000.0}, 20000.0), 0.0, 0.01);
}

TEST(BandFilter, TakesAwayAConstant) {
  BandFilter filter({20.0, 750.0}, kRate);
  double out = 1.0;
  for (int n = 0; n < 48000; ++n) out = filter.process(1.0);
  EXPECT_LT(std::abs(out), 1e-9);
}

}  // namespace
}  // namespace splash::synth
