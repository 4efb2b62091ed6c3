// SPDX-License-Identifier: MIT
// Events on simulated callbacks: each starts at its sample, whatever the callbacks' jitter.
#include "synth-server/play/player.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <random>

#include "tests/synth-server/render/rendering.hpp"

namespace splash::synth {
namespace {

constexpr int kBlock = 256;
constexpr double kStart = 1000.0;  // [s, monotonic]
constexpr double kLatency = 0.010;

class PlayerTest : public testing::Test {
 protected:
  PlayerTest()
      : engine_(rig_, file_settings()),
        player_(engine_, queue_, nullptr, {kRate, 4096, 0.0, false, {kLatency, 0.050, 2.0}}) {}

  /// When the next sample is due.
  [[nodiscard]] double now() const {
    return kStart + shift_ + static_cast<double>(samples_.size()) / kRate;
  }
  /// One callback, `late` after the moment at which its samples are due; keeps the left channel.
  void call(double late = 0.0, int frames = kBlock, bool xrun = false) {
    StereoBlock block(frames);
    player_.render({block.pointers.data(), frames, now() + late, xrun});
    samples_.insert(samples_.end(), block.left.begin(), block.left.end());
  }
  void calls(int count) {
    for (int i = 0; i < count; ++i) call();
  }
  void play(double moment, float radius = 0.001F, double by_arrival = 0.0) {
    ASSERT_TRUE(queue_.push({.event = protocol::Bubble{next_id_++, 0, radius, 0.05F, {}, 0.0F},
                             .moment = moment,
                             .by_arrival = by_arrival}));
  }
  void say(Command::Kind kind) { ASSERT_TRUE(queue_.push({.kind = kind, .event = {}})); }
  [[nodiscard]] std::int64_t onset_after(std::size_t from) const {
    for (std::size_t i = from; i < samples_.size(); ++i) {
      if (std::abs(samples_[i]) > 1e-6F) return static_cast<std::int64_t>(i);
    }
    return -1;
  }

  /// What was told for `moment` is heard at its sample, the first from `from` on.
  void expect_onset(double moment, std::size_t from) const {
    const std::int64_t ideal = std::llround((moment + kLatency - kStart - shift_) * kRate);
    EXPECT_NEAR(static_cast<double>(onset_after(from) - ideal), 1.0, 1.0);
  }

  Rig rig_ = shipped_rig("stereo");
  Engine engine_;
  CommandQueue queue_;
  Player player_;
  double shift_ = 0.0;  ///< by which the device's samples have moved [s]
  int next_id_ = 0;
  std::vector<float> samples_;
};

TEST_F(PlayerTest, StartsEventsAtTheirSampleDespiteJitter) {
  std::mt19937 random(3);
  std::uniform_real_distribution<double> jitter(-20e-6, 20e-6);
  for (int i = 0; i < 1500; ++i) call(jitter(random));  // 8 s: the clock has settled
  // The first sample of a bubble is sin(0): it is heard one or two after its start.
  std::vector<std::int64_t> errors;
  for (int event = 0; event < 40; ++event) {
    const std::size_t before = samples_.size();
    const double moment = now() + 0.011 + 0.000123 * event;
    play(moment);
    for (int i = 0; i < 40; ++i) call(jitter(random));
    const std::int64_t ideal = std::llround((moment + kLatency - kStart) * kRate);
    const std::int64_t heard = onset_after(before);
    ASSERT_GT(heard, 0);
    errors.push_back(heard - ideal);
  }
  const auto [least, most] = std::minmax_element(errors.begin(), errors.end());
  EXPECT_GE(*least, 0);
  EXPECT_LE(*most, 2);
  EXPECT_LE(*most - *least, 1) << "samples between the earliest and the latest";
  EXPECT_EQ(player_.counters().late, 0U);
  EXPECT_EQ(player_.counters().clock_resets, 0U);
}

TEST_F(PlayerTest, CountsAndPlaysTheLateDropsTheTooLate) {
  calls(100);
  play(now() - 0.030);
  play(now() - 0.500);
  play(now() + 3600.0, 0.001F, now() + 0.005);
  calls(10);
  EXPECT_EQ(player_.counters().late, 1U);
  EXPECT_EQ(player_.counters().too_late, 1U);
  EXPECT_EQ(player_.counters().early, 1U);
  EXPECT_EQ(engine_.counters().started.of<protocol::Bubble>(), 2U);
}

TEST_F(PlayerTest, AnXrunMovesTheSamplesAndTheClockFollows) {
  calls(1000);
  shift_ = 0.012;  // the device repeated what it had for 12 ms: too little to notice by itself
  call(0.0, kBlock, true);
  const std::size_t before = samples_.size();
  const double moment = now() + 0.015;
  play(moment);
  calls(20);
  expect_onset(moment, before);
  EXPECT_EQ(player_.counters().xruns, 1U);
  EXPECT_EQ(player_.counters().clock_resets, 1U);
}

TEST_F(PlayerTest, WhatWaitsDuringAnXrunStartsAtItsMoment) {
  calls(1000);
  const std::size_t before = samples_.size();
  const double moment = now() + 0.040;
  play(moment);
  call();  // it waits in the engine now
  shift_ = 0.012;
  call(0.0, kBlock, true);
  calls(20);
  expect_onset(moment, before);
  EXPECT_EQ(player_.counters().late, 0U);
}

TEST_F(PlayerTest, WhatALongStallOvertookIsCountedLateOrDropped) {
  calls(1000);
  const std::size_t before = samples_.size();
  const double start = now();
  play(start + 0.5);   // 1 s too late when the machine goes on
  play(start + 1.47);  // 30 ms: within the window
  play(start + 1.9);   // not overtaken
  call();
  EXPECT_EQ(engine_.counters().scheduled, 3U);
  shift_ = 1.5;
  call(0.0, kBlock, true);
  EXPECT_EQ(player_.counters().too_late, 1U);
  EXPECT_EQ(player_.counters().late, 1U);
  EXPECT_NEAR(static_cast<double>(onset_after(before)), static_cast<double>(before + kBlock), 2.0)
      << "the late one starts at once";
  calls(100);
  const std::size_t between = before + 16000;  // it has rung out
  expect_onset(start + 1.9, between);
  EXPECT_EQ(engine_.counters().started.of<protocol::Bubble>(), 2U);
  EXPECT_EQ(engine_.counters().scheduled, 0U);
}

TEST_F(PlayerTest, WhatWaitsKeepsItsSampleWhenOnlyCallbacksAreLate) {
  calls(1000);
  const std::size_t before = samples_.size();
  const double moment = now() + 0.020;
  play(moment);
  call();
  for (int i = 0; i < 5; ++i) call(0.030);  // the clock takes them for moved samples
  EXPECT_EQ(player_.counters().clock_resets, 1U);
  calls(20);
  expect_onset(moment, before);
}

TEST_F(PlayerTest, AThousandXrunsAreCountedAndVoicesKeepTheirClock) {
  Engine undisturbed(rig_, file_settings());
  std::vector<float> expected;
  std::mt19937 random(7);
  std::uniform_real_distribution<double> lost(0.0, 0.050);
  for (int i = 0; i < 4000; ++i) {
    const bool xrun = i % 4 == 3;
    if (xrun) shift_ += lost(random);  // what the device played meanwhile is not known
    if (i % 7 == 0 && i < 3600) {
      const protocol::Bubble bubble{i, 0, 0.01F, 0.05F, {}, 0.0F};
      ASSERT_TRUE(queue_.push({.event = bubble, .at_once = true}));
      undisturbed.schedule({bubble, undisturbed.clock()});
    }
    call(0.0, kBlock, xrun);
    const auto left = render(undisturbed, kBlock)[0];
    expected.insert(expected.end(), left.begin(), left.end());
  }
  EXPECT_EQ(player_.counters().xruns, 1000U);
  EXPECT_EQ(player_.counters().clock_resets, 1000U);
  EXPECT_EQ(engine_.counters().started.of<protocol::Bubble>(), 515U);
  EXPECT_EQ(engine_.counters().voices, 0U) << "none hangs";
  EXPECT_GT(onset_after(0), 0);
  EXPECT_EQ(samples_, expected) << "what sounds does not notice";
  const std::size_t before = samples_.size();
  const double moment = now() + 0.015;
  play(moment);
  calls(20);
  expect_onset(moment, before);
}

TEST_F(PlayerTest, CutsBlocksThatAreLargerThanTheEngines) {
  call(0.0, 10000);
  play(kStart + 10000.0 / kRate);
  call(0.0, 10000);
  const std::int64_t heard = onset_after(0);
  EXPECT_GE(heard, 10480);
  EXPECT_LE(heard, 10482);
}

TEST_F(PlayerTest, ClearingEndsVoicesAndWhatWaits) {
  calls(10);
  play(now(), 0.1F);        // sounds for seconds
  play(now() + 0.5, 0.1F);  // waits
  calls(20);
  ASSERT_GE(onset_after(samples_.size() - kBlock), 0);
  say(Command::Kind::clear_scheduled);
  calls(120);  // 0.64 s: filters ring, too
  const std::size_t silent_from = samples_.size();
  calls(200);
  EXPECT_EQ(onset_after(silent_from), -1) << "the waiting one neither";
  play(now());
  calls(10);
  EXPECT_GE(onset_after(silent_from), 0);
}

TEST_F(PlayerTest, FinishingFadesOutForGood) {
  play(kStart, 0.1F);
  calls(20);
  player_.finish();
  calls(10);
  EXPECT_TRUE(engine_.silenced());
  say(Command::Kind::unmute);
  play(now());
  calls(10);
  EXPECT_TRUE(engine_.silenced()) << "nothing opens it again";
}

}  // namespace
}  // namespace splash::synth
