// SPDX-License-Identifier: MIT
// What happens when voices run out: the quietest goes, and it goes without a click; and where the
// voices sit does not depend on how time is cut.
#include "synth-server/render/bubble_pool.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <vector>

#include "synth-server/render/voice_span.hpp"
#include "synth-server/voices/bubble_tone.hpp"

namespace splash::synth {
namespace {

constexpr double kRate = 48000.0;
constexpr double kFloor = 1e-8;
constexpr Route kRoute{0, 1.0};
using Start = BubblePool::Start;

PoolSettings settings_for(int voices) {
  return {.max_voices = voices, .sample_rate = kRate};
}

Start start(BubblePool& pool, double radius, std::int64_t sample, double epsilon = 0.05,
            bool kept = false) {
  const BubbleTone tone = paper_bubble(radius, epsilon);
  VoiceLife life = life_of(tone, kRate, kFloor);
  life.kept = kept;
  return pool.start(tone, life, {&kRoute, 1}, 0, sample);
}

double formula(double radius, std::int64_t start, double sample) {
  const double t = (sample - static_cast<double>(start)) / kRate;
  return t < 0.0 ? 0.0 : pressure(paper_bubble(radius, 0.05), t);
}

/// Mixes [from, to) in pieces of at most `most` samples, none beyond its cell.
std::vector<double> mix(BubblePool& pool, std::int64_t from, std::int64_t to,
                        std::int64_t most = kCell) {
  std::vector<double> out;
  Mix cell(1);
  for (std::int64_t at = from; at < to;) {
    const std::int64_t end = std::min({to, (at / kCell + 1) * kCell, at + most});
    pool.mix(at, end, cell);
    for (std::int64_t n = at; n < end; ++n) {
      out.push_back(cell.samples[static_cast<std::size_t>(n % kCell)]);
    }
    if (end % kCell == 0) {
      pool.release(end);
      cell = Mix(1);
    }
    at = end;
  }
  return out;
}

TEST(BubblePool, StealsTheQuietestAndRefusesTheQuieter) {
  BubblePool pool(settings_for(3));
  EXPECT_EQ(start(pool, 0.02, 0), Start::started);
  EXPECT_EQ(start(pool, 0.01, 0), Start::started);
  EXPECT_EQ(start(pool, 0.03, 0), Start::started);
  EXPECT_EQ(start(pool, 0.005, 10), Start::refused);
  EXPECT_EQ(start(pool, 0.015, 10), Start::stole);
  // The bubble of 1 cm fades: what remains after 5 ms are the other three.
  const auto out = mix(pool, 0, 4800);
  for (std::size_t n = 10 + 241; n < out.size(); ++n) {
    const auto at = static_cast<double>(n);
    const double expected = formula(0.02, 0, at) + formula(0.03, 0, at) + formula(0.015, 10, at);
    ASSERT_NEAR(out[n], expected, 1e-12) << n;
  }
}

TEST(BubblePool, CountsADecayedVoiceByWhatIsLeftOfIt) {
  BubblePool pool(settings_for(2));
  start(pool, 0.02, 0);  // d = 9: after 0.4 s down to 0.027 of 1 mm
  mix(pool, 0, 18944);
  start(pool, 0.004, 19000);
  mix(pool, 18944, 19200);
  EXPECT_EQ(start(pool, 0.003, 19200), Start::stole);
  const auto out = mix(pool, 19200, 19200 + 2000);
  // Stolen was the old large one: the small one still follows its formula.
  const double expected = formula(0.004, 19000, 20200.0) + formula(0.003, 19200, 20200.0);
  EXPECT_NEAR(out[1000], expected, 1e-12);
}

TEST(BubblePool, FindsTheQuietestOfThousandsAgainAndAgain) {
  // 2000 voices of rising loudness in shuffled order, then 500 louder ones: gone must be the 500
  // weakest, in spite of the ranking that is made only now and then.
  BubblePool pool(settings_for(2000));
  const auto radius = [](int rank) { return 0.01 + 1e-5 * rank; };
  for (int i = 0; i < 2000; ++i) {
    ASSERT_EQ(start(pool, radius(i * 1237 % 2000), 0), Start::started);
  }
  for (int i = 0; i < 500; ++i) ASSERT_EQ(start(pool, 0.04, i / 8), Start::stole);
  EXPECT_EQ(start(pool, radius(450), 63), Start::refused);
  EXPECT_EQ(start(pool, radius(550), 63), Start::stole);
}

TEST(BubblePool, StealsWithoutAClick) {
  // What is left of the stolen voice, sample by sample, once the thief's formula is taken away.
  constexpr double kRadius = 0.02;
  constexpr double kAmplitude = 0.05 * kRadius;
  constexpr std::int64_t kSteal = 1050;
  BubblePool pool(settings_for(1));
  start(pool, kRadius, 0);
  auto out = mix(pool, 0, kSteal);
  const double at_steal = out.back();
  ASSERT_GT(std::abs(at_steal), 0.3 * kAmplitude) << "a hard cut must be a click here";
  ASSERT_EQ(start(pool, 0.05, kSteal), Start::stole);
  const auto rest = mix(pool, kSteal, kSteal + 1000);
  double last = at_steal;
  double largest = 0.0;
  for (std::size_t n = 0; n < rest.size(); ++n) {
    const double residue = rest[n] - formula(0.05, 0, static_cast<double>(n));
    largest = std::max(largest, std::abs(residue - last));
    last = residue;
  }
  const double sine = kAmplitude * 2.0 * std::numbers::pi * 160.0 / kRate;
  const double fade = kAmplitude * 1.5 / (kVoiceFade * kRate);
  EXPECT_LT(largest, sine + fade);
  EXPECT_NEAR(last, 0.0, 1e-12);
}

TEST(BubblePool, EndsVoicesUnderTheFloorAndGivesTheirPlacesBack) {
  BubblePool pool(settings_for(4));
  start(pool, 0.004, 0);
  const auto length = life_of(paper_bubble(0.004, 0.05), kRate, kFloor).length;
  const auto out = mix(pool, 0, (length / kCell + 2) * kCell);
  EXPECT_EQ(pool.size(), 0U);
  EXPECT_EQ(out.back(), 0.0);
  EXPECT_NE(out[static_cast<std::size_t>(length) - 10], 0.0);
  EXPECT_EQ(out[static_cast<std::size_t>(length)], 0.0);
  EXPECT_LT(std::abs(out[static_cast<std::size_t>(length) - 1]), kFloor * 1.01);
}

TEST(BubblePool, FadesAVoiceBeforeItsPitchReachesNyquist) {
  BubblePool pool(settings_for(4));
  constexpr double kRadius = 0.00015;  // 20 kHz
  const VoiceLife life = life_of(paper_bubble(kRadius, 0.1), kRate, kFloor);
  ASSERT_LT(life.fold, life.length);
  start(pool, kRadius, 0, 0.1);
  const auto out = mix(pool, 0, life.fold + 200);
  for (std::size_t n = static_cast<std::size_t>(life.fold); n < out.size(); ++n) {
    ASSERT_EQ(out[n], 0.0);
  }
}

TEST(BubblePool, RefusesWhenFadingVoicesTakeAllPlaces) {
  BubblePool pool(settings_for(1));
  double radius = 0.01;
  int started = 0;
  while (start(pool, radius, 0) != Start::refused) {
    radius += 0.001;
    ASSERT_LT(++started, 1000);
  }
  EXPECT_GE(started, 16);
  mix(pool, 0, 320);
  EXPECT_EQ(pool.size(), 1U);
  EXPECT_EQ(start(pool, 0.2, 320), Start::stole);
}

Start start_kept(BubblePool& pool, double radius, std::int64_t sample, double epsilon = 0.05) {
  return start(pool, radius, sample, epsilon, true);
}

// However loud the others, and however many come after it.
TEST(BubblePool, KeepsAPlaceForWhatIsKept) {
  BubblePool pool(settings_for(64));
  for (int i = 0; i < 64; ++i) ASSERT_EQ(start(pool, 0.03, 0), Start::started);
  EXPECT_EQ(start(pool, 0.02, 0, 0.01), Start::refused);
  EXPECT_EQ(start_kept(pool, 0.02, 0, 0.01), Start::stole);
  for (int i = 0; i < 20; ++i) ASSERT_EQ(start(pool, 0.04, 0), Start::stole);
  const auto with = mix(pool, 0, 4800);
  BubblePool other(settings_for(64));
  for (int i = 0; i < 64; ++i) ASSERT_EQ(start(other, 0.03, 0), Start::started);
  for (int i = 0; i < 21; ++i) ASSERT_EQ(start(other, 0.04, 0), Start::stole);
  const auto without = mix(other, 0, 4800);
  const auto sound = [&](double radius, double epsilon) {
    return pressure(paper_bubble(radius, epsilon), 4000.0 / kRate);
  };
  // All stolen ones have faded out: they differ by the kept voice and one of the loud ones.
  EXPECT_NEAR(with[4000] - without[4000], sound(0.02, 0.01) - sound(0.04, 0.05), 1e-12);
}

TEST(BubblePool, KeepsNoMoreThanASixteenth) {
  BubblePool pool(settings_for(64));
  for (int i = 0; i < 64; ++i) ASSERT_EQ(start(pool, 0.03, 0), Start::started);
  for (int i = 0; i < 4; ++i) EXPECT_EQ(start_kept(pool, 0.01, 0), Start::stole);
  EXPECT_EQ(start_kept(pool, 0.01, 0), Start::refused);
  const VoiceLife life = life_of(paper_bubble(0.01, 0.05), kRate, kFloor);
  mix(pool, 0, (life.length / kCell + 1) * kCell);
  for (int i = 0; i < 64; ++i) start(pool, 0.03, (life.length / kCell + 1) * kCell);
  EXPECT_EQ(start_kept(pool, 0.01, (life.length / kCell + 1) * kCell), Start::stole)
      << "the places come back";
}

TEST(BubblePool, TakesLatecomersOfACellAsIfTheyHadBeenKnown) {
  // Known before the cell is begun, or only when the pieces have come that far: the same bits.
  BubblePool known(settings_for(40));
  BubblePool late(settings_for(40));
  std::vector<double> whole;
  std::vector<double> pieces;
  for (std::int64_t cell = 0; cell < 20; ++cell) {
    const std::int64_t begin = cell * kCell;
    for (int i = 0; i < 4; ++i) start(known, 0.002 * (i + 1), begin + 16 * i + 3);
    const auto sound = mix(known, begin, begin + kCell);
    whole.insert(whole.end(), sound.begin(), sound.end());
    for (int i = 0; i < 4; ++i) {
      const std::int64_t at = begin + 16 * i;
      start(late, 0.002 * (i + 1), at + 3);
      const auto piece = mix(late, at, at + 16, 5);
      pieces.insert(pieces.end(), piece.begin(), piece.end());
    }
  }
  EXPECT_EQ(pieces, whole);
}

}  // namespace
}  // namespace splash::synth
