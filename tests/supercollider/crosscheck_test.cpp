// SPDX-License-Identifier: MIT
// SuperCollider's server and synth-server render the same log: bubbles and cavities, sample by
// sample. scsynth computes in single precision; hence the tolerance.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <iostream>

#include "tests/pd-patches/rendering.hpp"
#include "tests/supercollider/comparison.hpp"

namespace splash::supercollider {
namespace {

using pd::decibels;

constexpr double kRate = 48000.0;
constexpr double kTolerance = -95.0;  ///< largest difference [dB]

double largest(const std::vector<float>& a, const std::vector<float>& b) {
  double most = 0.0;
  for (std::size_t i = 0; i < a.size(); ++i) {
    most = std::max(most, std::abs(static_cast<double>(a[i]) - static_cast<double>(b.at(i))));
  }
  return most;
}

double peak(const std::vector<float>& samples) {
  return largest(samples, std::vector<float>(samples.size()));
}

class OneBubble : public testing::TestWithParam<double> {};

TEST_P(OneBubble, IsTheSameWithin95Decibels) {
  const double radius = GetParam();
  const double damping = 0.13 / radius + 0.0072 * std::pow(radius, -1.5);
  const auto frames = 5000 + static_cast<std::int64_t>(std::min(11.0 / damping, 6.0) * kRate);
  const auto log = pd::make_log(
      {{4801.0 / kRate,
        protocol::Bubble{1, -1, static_cast<float>(radius), 0.1F, {0.0F, 0.0F, 0.0F}, 0.0F}}});
  const double gain = 0.9 / (0.1 * radius);
  const Pair both = render_both(log, frames, gain);
  const double level = decibels(largest(both.synth, both.scsynth) / 0.9);
  std::cout << "r = " << radius << " m: " << level << " dB re A0\n";
  EXPECT_GT(peak(both.synth), 0.3);
  EXPECT_LT(level, kTolerance);
}

INSTANTIATE_TEST_SUITE_P(Sizes, OneBubble, testing::Values(0.0045, 0.0123, 0.03, 0.08, 0.15));

TEST(Scsynth, StartsEachEventOnItsSample) {
  const std::vector<std::int64_t> samples = {0, 1, 63, 64, 65, 1000, 4799, 4800, 24001};
  for (const std::int64_t sample : samples) {
    const auto log =
        pd::make_log({{static_cast<double>(sample) / kRate,
                       protocol::Cavity{1, 0, 0.01F, 0.1F, {0.0F, 0.0F, 0.0F}, 0.0F}}});
    const Pair both = render_both(log, 26000, 500.0);
    const double level = 1e-9 * peak(both.synth);
    EXPECT_EQ(pd::first_beyond(both.synth, level), sample + 1);  // both begin with a sine's nil
    EXPECT_EQ(pd::first_beyond(both.scsynth, level), sample + 1);
  }
}

TEST(Scsynth, FadesACavityAfterItsLife) {
  const auto log =
      pd::make_log({{0.1, protocol::Cavity{1, 0, 0.06F, 0.1F, {0.0F, 0.0F, 0.0F}, 0.0F, 0.1372F}}});
  const double gain = 0.9 / (0.1 * 0.06);
  const Pair both = render_both(log, 48000, gain);
  const double level = decibels(largest(both.synth, both.scsynth) / 0.9);
  std::cout << "a cavity that breaks: " << level << " dB re A0\n";
  EXPECT_GT(peak(both.synth), 0.3);
  EXPECT_LT(level, kTolerance);
}

class Scene : public testing::TestWithParam<const char*> {};

TEST_P(Scene, SoundsAlike) {
  constexpr auto kFrames = static_cast<std::int64_t>(4.5 * kRate);
  const auto log = scene_log(GetParam());
  const Pair both = render_both(log, kFrames, loud_gain(log, kFrames));
  const double loudest = peak(both.synth);
  ASSERT_NEAR(loudest, 0.5, 0.01) << "a limiter acts: these cannot be compared";
  const double level = decibels(largest(both.synth, both.scsynth) / loudest);
  std::cout << GetParam() << ": " << level << " dB re its peak\n";
  EXPECT_LT(level, kTolerance);
}

INSTANTIATE_TEST_SUITE_P(Logs, Scene, testing::ValuesIn(kScenes));

}  // namespace
}  // namespace splash::supercollider
