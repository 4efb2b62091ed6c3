// SPDX-License-Identifier: MIT
// The delay-locked loop: exact on an exact clock, within a sample on a jittering one; and where in
// a block an event of some moment begins.
#include "synth-server/play/sample_clock.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <random>

namespace splash::synth {
namespace {

constexpr double kRate = 48000.0;
constexpr int kBlock = 256;
constexpr double kStart = 123456.0;  // a monotonic clock after a day and a half [s]

/// Calls the clock as a device of `rate` would, `jitter()` late; true start of block k is
/// kStart + k * kBlock / rate.
template <class Jitter>
void drive(SampleClock& clock, double rate, int from, int to, Jitter jitter) {
  for (int k = from; k < to; ++k) {
    clock.update(kStart + k * kBlock / rate + jitter(), std::int64_t{k} * kBlock, kBlock);
  }
}

double zero() {
  return 0.0;
}

/// The least and the most that the clock is ever off at a block's start [samples].
struct Errors {
  double least = 1e9;
  double most = -1e9;
};
template <class Jitter>
Errors errors(SampleClock& clock, int from, int to, Jitter jitter) {
  Errors all;
  for (int k = from; k < to; ++k) {
    drive(clock, kRate, k, k + 1, jitter);
    const double error = clock.sample_at(kStart + k * kBlock / kRate) - k * kBlock;
    all.least = std::min(all.least, error);
    all.most = std::max(all.most, error);
  }
  return all;
}

TEST(SampleClock, IsExactOnAnExactClock) {
  SampleClock clock(kRate);
  drive(clock, kRate, 0, 2000, zero);
  const double moment = kStart + 2000.0 * kBlock / kRate + 0.25;
  EXPECT_NEAR(clock.sample_at(moment), 2000.0 * kBlock + 0.25 * kRate, 1e-4);
  EXPECT_NEAR(clock.rate(), kRate, 1e-3);
}

TEST(SampleClock, FiltersJitterToLessThanASample) {
  // Half of the callbacks up to 100 us late, as measured on an idle JACK; some a whole millisecond.
  std::mt19937 random(7);
  std::uniform_real_distribution<double> uniform(0.0, 1.0);
  const auto jitter = [&] {
    const double draw = uniform(random);
    return draw > 0.99 ? 1e-3 : 1e-4 * draw;
  };
  SampleClock clock(kRate);
  drive(clock, kRate, 0, 2000, jitter);
  double worst = 0.0;
  for (int k = 2000; k < 4000; ++k) {
    drive(clock, kRate, k, k + 1, jitter);
    const double ideal = k * kBlock / kRate + kStart + 0.01;
    worst = std::max(worst, std::abs(clock.sample_at(ideal) - (k * kBlock + 0.01 * kRate)));
  }
  EXPECT_LT(worst, 1.0) << "samples; unfiltered it would be up to 47";
  EXPECT_EQ(clock.resets(), 0U);
}

TEST(SampleClock, HardlyMindsCallbacksThatAreLateByChance) {
  // As on a busy machine without realtime priority: one in thirty up to 15 ms late.
  std::mt19937 random(8);
  std::uniform_real_distribution<double> uniform(0.0, 1.0);
  const auto jitter = [&] {
    const double late = uniform(random) < 1.0 / 30.0 ? 15e-3 * uniform(random) : 0.0;
    return late + 40e-6 * uniform(random);
  };
  SampleClock clock(kRate);
  drive(clock, kRate, 0, 2000, jitter);
  const auto [least, most] = errors(clock, 2000, 6000, jitter);
  EXPECT_LT(most - least, 1.0) << "samples; each counted fully, it would be 20";
  EXPECT_LT(std::max(std::abs(least), std::abs(most)), 3.0);
  EXPECT_EQ(clock.resets(), 0U);
}

TEST(SampleClock, IsUsableFromTheFirstBlock) {
  SampleClock clock(kRate);
  drive(clock, kRate, 0, 1, zero);
  EXPECT_NEAR(clock.sample_at(kStart + 0.1), 4800.0, 1e-4);
}

TEST(SampleClock, FollowsTheRateOfARealCard) {
  for (const double drift : {80e-6, -80e-6}) {
    const double real = kRate * (1.0 + drift);
    SampleClock clock(kRate);
    drive(clock, real, 0, 8000, zero);  // 43 s
    EXPECT_NEAR(clock.rate(), real, 0.05);
    const double moment = kStart + 8000.0 * kBlock / real + 0.5;
    EXPECT_NEAR(clock.sample_at(moment), 8000.0 * kBlock + 0.5 * real, 0.5);
  }
}

TEST(SampleClock, RidesOnTheEarliestCallbacksWhateverTheLoad) {
  // Idle for a while, then so loaded that callbacks are late by up to 2 ms, then idle again.
  std::mt19937 random(9);
  std::uniform_real_distribution<double> uniform(0.0, 1.0);
  double load = 0.0;
  const auto jitter = [&] { return 30e-6 * uniform(random) + load * std::pow(uniform(random), 4); };
  SampleClock clock(kRate);
  drive(clock, kRate, 0, 2000, jitter);
  const Errors idle = errors(clock, 2000, 3000, jitter);
  load = 2e-3;
  const Errors loaded = errors(clock, 3000, 6000, jitter);
  load = 0.0;
  const Errors after = errors(clock, 6000, 8000, jitter);
  EXPECT_LT(std::max({idle.most, loaded.most, after.most}) -
                std::min({idle.least, loaded.least, after.least}),
            1.0)
      << "samples; a loop that heeds all callbacks wanders by 27";
}

TEST(SampleClock, CoastsThroughOneLateCallback) {
  SampleClock clock(kRate);
  drive(clock, kRate, 0, 1000, zero);
  drive(clock, kRate, 1000, 1001, [] { return 0.150; });
  drive(clock, kRate, 1001, 1002, zero);
  EXPECT_EQ(clock.resets(), 0U);
  EXPECT_NEAR(clock.sample_at(kStart), 0.0, 0.01);
}

TEST(SampleClock, StartsAnewWhenTheSamplesHaveMoved) {
  SampleClock clock(kRate);
  drive(clock, kRate, 0, 1000, zero);
  drive(clock, kRate, 1000, 1010, [] { return 0.150; });  // the device paused for 150 ms
  EXPECT_EQ(clock.resets(), 1U);
  EXPECT_NEAR(clock.sample_at(kStart + 0.150), 0.0, 0.5);
}

TEST(SampleClock, StartsAnewAfterAReset) {
  SampleClock clock(kRate);
  drive(clock, kRate, 0, 1000, zero);
  clock.reset();
  drive(clock, kRate, 1000, 1001, [] { return 0.004; });  // too little to notice without
  EXPECT_EQ(clock.resets(), 1U);
  EXPECT_NEAR(clock.sample_at(kStart + 0.004), 0.0, 1e-4);
}

TEST(SampleClock, StartsAnewWhenBlocksAreMissing) {
  SampleClock clock(kRate);
  drive(clock, kRate, 0, 10, zero);
  drive(clock, kRate, 20, 21, zero);
  EXPECT_EQ(clock.resets(), 1U);
  EXPECT_NEAR(clock.sample_at(kStart), 0.0, 1e-4);
}

constexpr double kNow = 1000.0;  // start of the block [s]
constexpr std::int64_t kBlockStart = 96000;

class Schedule : public testing::Test {
 protected:
  Schedule() { clock_.update(kNow, kBlockStart, 256); }
  [[nodiscard]] Placement at(double moment, double by_arrival = kNow) const {
    return place(moment, by_arrival, clock_, kBlockStart, settings_);
  }
  SampleClock clock_{kRate};
  ScheduleSettings settings_{0.010, 0.050, 2.0};
};

TEST_F(Schedule, AddsTheLatency) {
  const Placement placement = at(kNow + 0.1);
  EXPECT_EQ(placement.timing, Timing::on_time);
  EXPECT_EQ(placement.sample, kBlockStart + 4800 + 480);
}

TEST_F(Schedule, RoundsToTheNearestSample) {
  EXPECT_EQ(at(kNow + 0.4 / kRate).sample, kBlockStart + 480);
  EXPECT_EQ(at(kNow + 0.6 / kRate).sample, kBlockStart + 481);
}

TEST_F(Schedule, PlaysAtOnceWhatIsALittleLate) {
  EXPECT_EQ(at(kNow - 0.010).timing, Timing::on_time) << "just covered by the latency";
  for (const double late : {0.0101, 0.030, 0.0599}) {
    const Placement placement = at(kNow - late);
    EXPECT_EQ(placement.timing, Timing::late) << late;
    EXPECT_EQ(placement.sample, kBlockStart) << late;
  }
}

TEST_F(Schedule, DropsWhatIsTooLate) {
  EXPECT_EQ(at(kNow - 0.0601).timing, Timing::too_late);
  EXPECT_EQ(at(kNow - 3600.0).timing, Timing::too_late);
}

TEST_F(Schedule, GoesByArrivalBeyondTheHorizon) {
  EXPECT_EQ(at(kNow + 1.99).timing, Timing::on_time);
  const Placement placement = at(kNow + 3600.0, kNow + 0.020);
  EXPECT_EQ(placement.timing, Timing::early);
  EXPECT_EQ(placement.sample, kBlockStart + 960 + 480);
}

TEST_F(Schedule, NeverWaitsLongerThanTheHorizon) {
  const Placement placement = at(kNow + 3600.0, kNow + 100.0);
  EXPECT_EQ(placement.timing, Timing::early);
  EXPECT_EQ(placement.sample, kBlockStart + 96000 + 480);
}

TEST_F(Schedule, PlaysWhatHasNoTimeWithTheNextBlock) {
  EXPECT_EQ(place_at_once(0.0, kBlockStart, kRate, settings_).sample, kBlockStart);
  const Placement later = place_at_once(0.1, kBlockStart, kRate, settings_);
  EXPECT_EQ(later.timing, Timing::on_time);
  EXPECT_EQ(later.sample, kBlockStart + 4800) << "no latency on top";
  const Placement wild = place_at_once(10.0, kBlockStart, kRate, settings_);
  EXPECT_EQ(wild.timing, Timing::early);
  EXPECT_EQ(wild.sample, kBlockStart + 96000);
}

TEST(Latency, IsWhatIsWantedOrWhatTheBlockNeeds) {
  EXPECT_DOUBLE_EQ(latency_for(0.020, 256, kRate), 0.020);
  EXPECT_DOUBLE_EQ(latency_for(0.0, 256, kRate), 0.0);
  EXPECT_DOUBLE_EQ(latency_for(-1.0, 1024, kRate), 1536.0 / kRate);
  EXPECT_DOUBLE_EQ(latency_for(-1.0, 64, kRate), 0.005);
}

}  // namespace
}  // namespace splash::synth
