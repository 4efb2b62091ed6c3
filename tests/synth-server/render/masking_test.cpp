// SPDX-License-Identifier: MIT
// A bubble is covered by a stronger one of its pitch in all its channels, and only as long as all
// that are covered together stay 25 dB below.
#include "synth-server/render/masking.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "synth-server/voices/paper_bubble.hpp"

namespace splash::synth {
namespace {

constexpr double kRate = 48000.0;
constexpr Route kHere[] = {{0, 1.0}, {1, 0.5}};

class MaskingTest : public testing::Test {
 protected:
  BubbleTone tone(double radius, double level_db) {
    return paper_bubble(radius, std::pow(10.0, level_db / 20.0));
  }
  void sound(const BubbleTone& voice, std::int64_t sample) {
    const VoiceLife life = life_of(voice, kRate, 1e-9);
    ranking_.enter(place_, life, sample, sample + life.length);
    masking_.note(voice, kHere, sample, place_++, ranking_);
  }
  bool covered(const BubbleTone& voice, std::int64_t sample,
               std::span<const Route> routes = kHere) {
    return masking_.covers(voice, routes, sample, ranking_);
  }

  Ranking ranking_{16, kRate};
  Masking masking_{3, kRate};
  std::uint32_t place_ = 0;
};

TEST_F(MaskingTest, CoversTheWeakOfTheSamePitch) {
  EXPECT_FALSE(covered(tone(0.00498, -40.0), 0)) << "nothing sounds yet";
  sound(tone(0.005, 0.0), 0);
  EXPECT_TRUE(covered(tone(0.00498, -40.0), 10));
  EXPECT_FALSE(covered(tone(0.00498, -15.0), 10)) << "too strong";
  EXPECT_FALSE(covered(tone(0.00502, -40.0), 10)) << "rings longer than the other";
  EXPECT_FALSE(covered(tone(0.0035, -40.0), 10)) << "higher by half an octave";
  constexpr Route kElsewhere[] = {{0, 1.0}, {2, 0.5}};
  EXPECT_FALSE(covered(tone(0.00498, -40.0), 10, kElsewhere)) << "felt alone in channel 2";
}

TEST_F(MaskingTest, CountsWhatItLeavesOut) {
  sound(tone(0.005, 0.0), 0);
  int left_out = 0;
  while (covered(tone(0.00499999, -35.1), 0) && left_out < 100) ++left_out;
  EXPECT_EQ(left_out, 9) << "each has 3.1e-4 of the masker's power";
}

TEST_F(MaskingTest, EndsWithTheMasker) {
  const BubbleTone strong = tone(0.005, 0.0);
  sound(strong, 0);
  // 46.4 per second: after 0.1 s the strong one is 40 dB down.
  EXPECT_TRUE(covered(tone(0.00498, -70.0), 0));
  EXPECT_FALSE(covered(tone(0.00498, -50.0), 4800));
  ranking_.end_at(0, 4800);
  EXPECT_FALSE(covered(tone(0.00498, -90.0), 4801)) << "it was told to make room";
}

TEST_F(MaskingTest, TakesTheStrongestAsTheMasker) {
  sound(tone(0.005, -20.0), 0);
  EXPECT_FALSE(covered(tone(0.00498, -40.0), 1));
  sound(tone(0.005, 0.0), 1);
  EXPECT_TRUE(covered(tone(0.00498, -40.0), 1));
  sound(tone(0.005, -10.0), 2);
  EXPECT_TRUE(covered(tone(0.00498, -40.0), 2));
}

}  // namespace
}  // namespace splash::synth
