// SPDX-License-Identifier: MIT
// A steady sound over the limit is turned down, not bent: anywhere in the band, however low that
// begins.
#include "synth-server/output/limiter.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <vector>

namespace splash::synth {
namespace {

constexpr double kRate = 48000.0;

/// Effective value of what is no sine of `frequency` in the second second, over that sine's [dB].
double distortion_db(Limiter limiter, double frequency, double amplitude) {
  const auto turn = [&](int n) { return 2.0 * std::numbers::pi * frequency * n / kRate; };
  std::vector<double> out;
  for (int n = 0; n < 96000; ++n) {
    out.push_back(limiter.process(amplitude * std::sin(turn(n)), 0.9));
  }
  double sine = 0.0;
  double cosine = 0.0;
  for (int n = 48000; n < 96000; ++n) {  // whole periods of whole frequencies
    sine += out[static_cast<std::size_t>(n)] * std::sin(turn(n)) / 24000.0;
    cosine += out[static_cast<std::size_t>(n)] * std::cos(turn(n)) / 24000.0;
  }
  double rest = 0.0;
  for (int n = 48000; n < 96000; ++n) {
    const double bent =
        out[static_cast<std::size_t>(n)] - sine * std::sin(turn(n)) - cosine * std::cos(turn(n));
    rest += bent * bent / 24000.0;
  }
  EXPECT_NEAR(std::hypot(sine, cosine), 0.9, 0.002) << frequency << " Hz";
  return 10.0 * std::log10(rest / (sine * sine + cosine * cosine));
}

TEST(Limiter, BendsNoSteadySineOfItsBand) {
  for (const double lowest : {1.0, 12.0, 20.0, 80.0}) {
    for (const double over_db : {3.0, 12.0, 24.0}) {
      const double amplitude = 0.9 * std::pow(10.0, over_db / 20.0);
      for (const double frequency : {lowest, lowest + 3.0, 150.0, 251.0, 420.0, 749.0}) {
        EXPECT_LT(distortion_db(Limiter(lowest, kRate), frequency, amplitude), -60.0)
            << frequency << " Hz, " << over_db << " dB over, band from " << lowest << " Hz";
      }
    }
  }
}

TEST(Limiter, LeavesAloneWhatIsUnderItsLimitAndComesBack) {
  Limiter limiter(20.0, kRate);
  EXPECT_EQ(limiter.process(-0.89, 0.9), -0.89);
  EXPECT_FALSE(limiter.limiting());
  EXPECT_DOUBLE_EQ(limiter.process(9.0, 0.9), 0.9);
  int turned_down = 0;
  while (limiter.process(0.1, 0.9) < 0.1 && turned_down < 96000) ++turned_down;
  // The window of 25 to 28 ms, and 20 dB at a time constant of 250 ms.
  EXPECT_NEAR(turned_down / kRate, 0.0265 + 0.25 * std::log(10.0), 0.003);
}

}  // namespace
}  // namespace splash::synth
