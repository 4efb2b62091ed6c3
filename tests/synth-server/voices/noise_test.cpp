// SPDX-License-Identifier: MIT
// The noise is white, of unit variance, the same for the same event and another for another.
#include "synth-server/voices/noise.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <complex>
#include <vector>

namespace splash::synth {
namespace {

constexpr std::size_t kSamples = 1U << 16U;

std::vector<double> draw(std::uint64_t seed, std::uint64_t event) {
  const Noise noise(seed, event);
  std::vector<double> out(kSamples);
  for (std::size_t n = 0; n < kSamples; ++n) out[n] = noise.at(n);
  return out;
}

double correlation(const std::vector<double>& a, const std::vector<double>& b, std::size_t lag) {
  double sum = 0.0;
  for (std::size_t n = lag; n < a.size(); ++n) sum += a[n] * b[n - lag];
  return sum / static_cast<double>(a.size() - lag);
}

/// Four and a half standard deviations of a mean of kSamples values of variance 1.
const double kChance = 4.5 / std::sqrt(static_cast<double>(kSamples));

TEST(Noise, HasMeanZeroVarianceOneAndItsBounds) {
  const auto x = draw(1, 7);
  double mean = 0.0;
  for (const double v : x) mean += v / static_cast<double>(kSamples);
  EXPECT_LT(std::abs(mean), kChance);
  EXPECT_NEAR(correlation(x, x, 0), 1.0, kChance);  // the variance of a uniform's square is 0.8
  const auto [least, most] = std::minmax_element(x.begin(), x.end());
  EXPECT_GE(*least, -std::sqrt(3.0));
  EXPECT_LT(*most, std::sqrt(3.0));
  EXPECT_GT(*most - *least, 3.46);
}

TEST(Noise, HasNoMemory) {
  const auto x = draw(1, 7);
  for (std::size_t lag = 1; lag <= 200; ++lag) {
    EXPECT_LT(std::abs(correlation(x, x, lag)), kChance) << "lag " << lag;
  }
}

TEST(Noise, HasAFlatSpectrum) {
  // Mean periodogram of 256 frames of 256 samples; each bin has a standard deviation of 1/16.
  const auto x = draw(3, 1);
  for (std::size_t bin = 1; bin < 128; ++bin) {
    double power = 0.0;
    for (std::size_t frame = 0; frame < 256; ++frame) {
      std::complex<double> sum = 0.0;
      for (std::size_t n = 0; n < 256; ++n) {
        const double angle = -2.0 * std::numbers::pi * static_cast<double>(bin * n % 256) / 256.0;
        sum += x[frame * 256 + n] * std::polar(1.0, angle);
      }
      power += std::norm(sum) / 256.0 / 256.0;
    }
    EXPECT_NEAR(power, 1.0, 4.5 / 16.0) << "bin " << bin;
  }
}

TEST(Noise, DependsOnSeedEventAndCounterOnly) {
  EXPECT_EQ(draw(1, 7), draw(1, 7));
  const auto x = draw(1, 7);
  for (const auto& [seed, event] : {std::pair{1U, 8U}, {2U, 7U}, {7U, 1U}, {0U, 0U}}) {
    const auto y = draw(seed, event);
    for (std::size_t lag = 0; lag < 8; ++lag) {
      EXPECT_LT(std::abs(correlation(x, y, lag)), kChance) << seed << " " << event;
      EXPECT_LT(std::abs(correlation(y, x, lag)), kChance) << seed << " " << event;
    }
  }
}

}  // namespace
}  // namespace splash::synth
