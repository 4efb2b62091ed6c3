// SPDX-License-Identifier: MIT
// Whatever comes in: finite, within the ceiling, and clean again a moment later. What needs no
// guarding passes untouched.
#include "synth-server/output/output_guard.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <limits>
#include <numbers>
#include <string>
#include <vector>

#include "synth-server/output/fade.hpp"

namespace splash::synth {
namespace {

constexpr double kRate = 48000.0;
constexpr int kBlock = 256;

Output tile() {
  Output output;
  output.name = "tile";
  output.ceiling = 0.8;
  return output;
}

using Signal = std::function<double(int)>;

double clean(int n) {
  return 0.25 * std::sin(2.0 * std::numbers::pi * 150.0 * n / kRate);
}

std::vector<float> run(OutputGuard& guard, const Signal& signal, int from, int blocks) {
  std::vector<double> in(kBlock);
  const std::vector<double> open(kBlock, 1.0);
  std::vector<float> out(static_cast<std::size_t>(blocks) * kBlock);
  for (int b = 0; b < blocks; ++b) {
    for (int i = 0; i < kBlock; ++i)
      in[static_cast<std::size_t>(i)] = signal(from + b * kBlock + i);
    guard.process(in.data(), open.data(), out.data() + b * kBlock, kBlock);
  }
  return out;
}

struct Hostile {
  std::string name;
  Signal signal;
};

std::vector<Hostile> hostiles() {
  constexpr double kNan = std::numeric_limits<double>::quiet_NaN();
  constexpr double kInf = std::numeric_limits<double>::infinity();
  return {{"nan", [](int) { return kNan; }},
          {"one_nan", [](int n) { return n % kBlock == 100 ? kNan : clean(n); }},
          {"inf", [](int n) { return n % 2 == 0 ? kInf : -kInf; }},
          {"one_inf", [](int n) { return n % kBlock == 100 ? kInf : clean(n); }},
          {"huge", [](int n) { return n % 3 == 0 ? 1e30 : -1e30; }},
          {"huge_then_nan", [](int n) { return n % kBlock < 99 ? 1e300 : kNan; }},
          {"denormals", [](int n) { return n % 2 == 0 ? 1e-310 : -1e-310; }},
          {"constant", [](int) { return 10.0; }},
          {"steps", [](int n) { return n / 37 % 2 == 0 ? 3.0 : -3.0; }},
          {"nyquist", [](int n) { return n % 2 == 0 ? 100.0 : -100.0; }},
          {"at_limit", [](int) { return std::numeric_limits<double>::max(); }}};
}

class GuardAgainst : public testing::TestWithParam<Hostile> {};
INSTANTIATE_TEST_SUITE_P(All, GuardAgainst, testing::ValuesIn(hostiles()),
                         [](const auto& hostile) { return hostile.param.name; });

TEST_P(GuardAgainst, StaysFiniteAndWithinTheCeilingAndRecovers) {
  OutputGuard guard(tile(), kRate);
  run(guard, clean, 0, 20);
  constexpr int kAt = 20 * kBlock;
  auto out = run(guard, GetParam().signal, kAt, 3);
  const auto after = run(guard, clean, kAt + 3 * kBlock, 1);
  out.insert(out.end(), after.begin(), after.end());
  for (const float sample : out) {
    ASSERT_TRUE(std::isfinite(sample));
    ASSERT_LE(std::abs(sample), 0.8F);
  }
  // Within two seconds all of it is forgotten, limiter and filters alike.
  constexpr int kLater = kAt + 4 * kBlock;
  constexpr int kBlocks = 2 * 48000 / kBlock;
  run(guard, clean, kLater, kBlocks);
  OutputGuard spared(tile(), kRate);
  run(spared, clean, 0, 20 + 4 + kBlocks);
  const auto mine = run(guard, clean, kLater + kBlocks * kBlock, 4);
  const auto theirs = run(spared, clean, kLater + kBlocks * kBlock, 4);
  for (std::size_t i = 0; i < mine.size(); ++i) ASSERT_NEAR(mine[i], theirs[i], 1e-4F);
}

TEST(OutputGuard, IsCleanOneBlockAfterNotANumber) {
  OutputGuard guard(tile(), kRate);
  run(
      guard, [](int) { return std::numeric_limits<double>::quiet_NaN(); }, 0, 1);
  EXPECT_EQ(guard.resets(), static_cast<std::uint64_t>(kBlock));
  OutputGuard fresh(tile(), kRate);
  EXPECT_EQ(run(guard, clean, kBlock, 8), run(fresh, clean, kBlock, 8));
}

TEST(OutputGuard, HoldsEvenAFilterThatBlowsUp) {
  // A high-pass beyond Nyquist has poles outside the unit circle.
  OutputGuard guard(tile(), 30.0);
  const auto out = run(guard, clean, 0, 100);
  EXPECT_GT(guard.resets(), 0U) << "the filter was stable: this proves nothing";
  for (const float sample : out) {
    ASSERT_TRUE(std::isfinite(sample));
    ASSERT_LE(std::abs(sample), 0.8F);
  }
}

TEST(OutputGuard, IsLinearBelowTheCeiling) {
  OutputGuard loud(tile(), kRate);
  OutputGuard soft(tile(), kRate);
  const auto a = run(
      loud, [](int n) { return 2.8 * clean(n); }, 0, 200);
  const auto b = run(
      soft, [](int n) { return 0.0028 * clean(n); }, 0, 200);
  for (std::size_t i = 0; i < a.size(); ++i) ASSERT_NEAR(a[i], 1000.0F * b[i], 1e-6F);
  EXPECT_EQ(loud.limited(), 0U);
  EXPECT_NEAR(*std::max_element(a.end() - 1000, a.end()), 0.7, 0.005);
}

TEST(OutputGuard, TurnsLoudSinesDownToTheCeilingWithoutCuttingThem) {
  OutputGuard guard(tile(), kRate);
  const auto out = run(
      guard, [](int n) { return 16.0 * clean(n); }, 0, 400);  // 14 dB over
  EXPECT_GT(guard.limited(), 0U);
  // In the steady state the limiter's gain hardly moves: the third harmonic stays 30 dB down.
  double first = 0.0;
  double third = 0.0;
  const std::size_t count = 320 * 60;  // whole periods of 150 Hz
  const std::size_t begin = out.size() - count;
  for (std::size_t n = 0; n < count; ++n) {
    const double phase = 2.0 * std::numbers::pi * 150.0 * static_cast<double>(n) / kRate;
    const auto value = static_cast<double>(out[begin + n]);
    first += value * std::sin(phase) * 2.0 / static_cast<double>(count);
    third += value * std::sin(3.0 * phase) * 2.0 / static_cast<double>(count);
  }
  EXPECT_GT(std::abs(first), 0.7);
  EXPECT_LT(std::abs(third), std::abs(first) * 0.03);
}

TEST(OutputGuard, LimitsTheSlewOfSteps) {
  OutputGuard guard(tile(), kRate);
  const auto out = run(
      guard, [](int n) { return n < 1000 ? 0.0 : 16.0; }, 0, 40);
  const double most = 2.0 * 2.0 * std::numbers::pi * 750.0 * 0.8 / kRate;
  for (std::size_t i = 1; i < out.size(); ++i) {
    ASSERT_LE(std::abs(static_cast<double>(out[i]) - static_cast<double>(out[i - 1])), most + 1e-6);
  }
}

/// Of the last `count` samples.
double effective(const std::vector<float>& out, std::size_t count) {
  double sum = 0.0;
  for (std::size_t n = out.size() - count; n < out.size(); ++n) {
    sum += static_cast<double>(out[n]) * static_cast<double>(out[n]);
  }
  return std::sqrt(sum / static_cast<double>(count));
}

TEST(OutputGuard, KeepsWithinTheHeatThatItsTransducerBears) {
  Output output = tile();
  output.heat = {0.2, 1.0};
  OutputGuard guard(output, kRate);
  const auto loud = [](int n) { return 2.8 * clean(n); };  // 0.7: effectively 0.49
  const auto begin = run(guard, loud, 0, 20);
  EXPECT_NEAR(effective(begin, 2400), 0.49, 0.02) << "a short sound is played as it is";
  const auto warm = run(guard, loud, 20 * kBlock, 1880);  // ten seconds
  EXPECT_LE(effective(warm, 48000), 0.2);
  EXPECT_GT(effective(warm, 48000), 0.17) << "nor is it turned down by more than it must";
  const auto half = [](int n) { return 0.5 * clean(n); };
  OutputGuard cold(output, kRate);
  run(cold, half, 0, 1000);
  EXPECT_EQ(cold.limited(), 0U) << "what it bears for ever is left alone";
  // As quiet afterwards as its coil cools: in three time constants all is as it was.
  run(
      guard, [](int) { return 0.0; }, 1900 * kBlock, 3 * 48000 / kBlock);
  EXPECT_NEAR(effective(run(guard, loud, 0, 20), 2400), 0.49, 0.02);
}

TEST(OutputGuard, RemembersItsHeatWhenNumbersAreBad) {
  Output output = tile();
  output.heat = {0.2, 1.0};
  OutputGuard guard(output, kRate);
  const auto loud = [](int n) { return 2.8 * clean(n); };
  run(guard, loud, 0, 1000);
  run(
      guard, [](int) { return std::numeric_limits<double>::quiet_NaN(); }, 0, 1);
  EXPECT_LT(effective(run(guard, loud, 0, 20), 2400), 0.25);
}

TEST(OutputGuard, SettlesToExactSilence) {
  OutputGuard guard(tile(), kRate);
  run(guard, clean, 0, 10);
  EXPECT_FALSE(guard.settle());
  const auto nothing = [](int) { return 0.0; };
  int blocks = 0;
  while (!guard.settle() && blocks < 1000) {
    run(guard, nothing, 0, 1);
    ++blocks;
  }
  EXPECT_LT(blocks, 1000);
  for (const float sample : run(guard, nothing, 0, 4)) ASSERT_EQ(sample, 0.0F);
}

TEST(Fade, OpensSlowlyOnceAndClosesInTwentyMilliseconds) {
  Fade fade(2.0, kRate);
  EXPECT_TRUE(fade.closed());
  double last = 0.0;
  for (int n = 0; n < 96001; ++n) {
    const double gain = fade.next(true);
    ASSERT_GE(gain, last);
    ASSERT_LT(gain - last, 1e-4);
    last = gain;
    if (n == 48000) {
      EXPECT_NEAR(gain, 0.5, 1e-4);
    }
  }
  EXPECT_EQ(fade.next(true), 1.0);
  for (int n = 0; n < 961; ++n) last = fade.next(false);
  EXPECT_TRUE(fade.closed());
  for (int n = 0; n < 962; ++n) last = fade.next(true);  // the second time it is quick
  EXPECT_EQ(last, 1.0);
}

TEST(Fade, OfNoLengthIsOpenFromTheFirstSample) {
  Fade fade(0.0, kRate);
  EXPECT_EQ(fade.next(true), 1.0);
}

}  // namespace
}  // namespace splash::synth
