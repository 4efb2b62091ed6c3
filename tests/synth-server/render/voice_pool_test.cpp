// SPDX-License-Identifier: MIT
// What happens when voices run out: the quietest goes, and it goes without a click.
#include "synth-server/render/voice_pool.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "synth-server/voices/bubble_formula.hpp"

namespace splash::synth {
namespace {

constexpr double kRate = 48000.0;
constexpr double kFloor = 1e-8;
constexpr Route kRoute{0, 1.0};

VoicePool::Start start(VoicePool& pool, double radius, std::int64_t sample, double epsilon = 0.05) {
  return pool.start(BubbleVoice(radius, epsilon, kRate, Chirp::literal),
                    bubble_life(radius, epsilon, kRate, Chirp::literal, kFloor), {&kRoute, 1},
                    sample);
}

/// Mixes [from, to) cell by cell.
std::vector<double> mix(VoicePool& pool, std::int64_t from, std::int64_t to) {
  std::vector<double> out;
  for (std::int64_t at = from; at < to;) {
    const std::int64_t end = std::min(to, (at / kCell + 1) * kCell);
    Mix cell{std::vector<double>(kCell, 0.0), std::vector<char>(1, 0)};
    pool.mix(at, end, cell);
    pool.release(end);
    for (std::int64_t n = at; n < end; ++n) {
      out.push_back(cell.samples[static_cast<std::size_t>(n % kCell)]);
    }
    at = end;
  }
  return out;
}

TEST(VoicePool, StealsTheQuietestAndRefusesTheQuieter) {
  VoicePool pool(3, 1, kRate);
  EXPECT_EQ(start(pool, 0.02, 0), VoicePool::Start::started);
  EXPECT_EQ(start(pool, 0.01, 0), VoicePool::Start::started);
  EXPECT_EQ(start(pool, 0.03, 0), VoicePool::Start::started);
  EXPECT_EQ(start(pool, 0.005, 10), VoicePool::Start::refused);
  EXPECT_EQ(start(pool, 0.015, 10), VoicePool::Start::stole);
  // The bubble of 1 cm fades: what remains after 5 ms are the other three.
  const auto out = mix(pool, 0, 4800);
  for (std::size_t n = 10 + 241; n < out.size(); ++n) {
    const double t = static_cast<double>(n) / kRate;
    const double expected = bubble_pressure(0.02, 0.05, t, Chirp::literal) +
                            bubble_pressure(0.03, 0.05, t, Chirp::literal) +
                            bubble_pressure(0.015, 0.05, t - 10 / kRate, Chirp::literal);
    ASSERT_NEAR(out[n], expected, 1e-12) << n;
  }
}

TEST(VoicePool, CountsADecayedVoiceByWhatIsLeftOfIt) {
  VoicePool pool(2, 1, kRate);
  start(pool, 0.02, 0);  // d = 9: after 0.4 s down to 0.027 of 1 mm
  start(pool, 0.004, 19000);
  mix(pool, 0, 19200);
  EXPECT_EQ(start(pool, 0.003, 19200), VoicePool::Start::stole);
  const auto out = mix(pool, 19200, 19200 + 2000);
  // Stolen was the old large one: the small one still follows its formula.
  const double t = (19200.0 + 1000.0) / kRate;
  const double expected = bubble_pressure(0.004, 0.05, t - 19000 / kRate, Chirp::literal) +
                          bubble_pressure(0.003, 0.05, t - 19200 / kRate, Chirp::literal);
  EXPECT_NEAR(out[1000], expected, 1e-12);
}

TEST(VoicePool, StealsWithoutAClick) {
  // What is left of the stolen voice, sample by sample, once the thief's formula is taken away.
  constexpr double kRadius = 0.02;
  constexpr double kAmplitude = 0.05 * kRadius;
  constexpr std::int64_t kSteal = 1050;
  VoicePool pool(1, 1, kRate);
  start(pool, kRadius, 0);
  auto out = mix(pool, 0, kSteal);
  const double at_steal = out.back();
  ASSERT_GT(std::abs(at_steal), 0.3 * kAmplitude) << "a hard cut must be a click here";
  ASSERT_EQ(start(pool, 0.05, kSteal), VoicePool::Start::stole);
  const auto rest = mix(pool, kSteal, kSteal + 1000);
  double last = at_steal;
  double largest = 0.0;
  for (std::size_t n = 0; n < rest.size(); ++n) {
    const double t = static_cast<double>(n) / kRate;
    const double residue = rest[n] - bubble_pressure(0.05, 0.05, t, Chirp::literal);
    largest = std::max(largest, std::abs(residue - last));
    last = residue;
  }
  const double sine = kAmplitude * 2.0 * std::numbers::pi * 160.0 / kRate;
  const double fade = kAmplitude * 1.5 / (VoicePool::kFade * kRate);
  EXPECT_LT(largest, sine + fade);
  EXPECT_NEAR(last, 0.0, 1e-12);
}

TEST(VoicePool, EndsVoicesUnderTheFloorAndGivesTheirPlacesBack) {
  VoicePool pool(4, 1, kRate);
  start(pool, 0.004, 0);
  const auto length = bubble_life(0.004, 0.05, kRate, Chirp::literal, kFloor).length;
  const auto out = mix(pool, 0, length + 64);
  EXPECT_EQ(pool.size(), 0U);
  EXPECT_EQ(out.back(), 0.0);
  EXPECT_LT(std::abs(out[static_cast<std::size_t>(length) - 1]), kFloor * 1.01);
}

TEST(VoicePool, FadesAVoiceBeforeItsPitchReachesNyquist) {
  VoicePool pool(4, 1, kRate);
  constexpr double kRadius = 0.00015;  // 20 kHz
  const VoiceLife life = bubble_life(kRadius, 0.1, kRate, Chirp::literal, 1e-12);
  ASSERT_LT(life.fold, life.length);
  start(pool, kRadius, 0, 0.1);
  const auto out = mix(pool, 0, life.fold + 200);
  for (std::size_t n = static_cast<std::size_t>(life.fold); n < out.size(); ++n) {
    ASSERT_EQ(out[n], 0.0);
  }
}

TEST(VoicePool, IsFullOnlyWhenFadingVoicesTakeAllPlaces) {
  VoicePool pool(2, 1, kRate);  // 2 + 1 + 16 places
  double radius = 0.01;
  int started = 0;
  while (!pool.full()) {
    EXPECT_NE(start(pool, radius, 0), VoicePool::Start::refused);
    radius += 0.001;
    ++started;
  }
  EXPECT_EQ(started, 19);
  mix(pool, 0, 300);
  EXPECT_FALSE(pool.full());
  EXPECT_EQ(pool.size(), 2U);
}

}  // namespace
}  // namespace splash::synth
