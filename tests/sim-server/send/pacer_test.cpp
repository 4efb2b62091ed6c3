// SPDX-License-Identifier: MIT
// Pacing on clocks of the test's own: nothing here waits for real; and the pace of the last second,
// whatever was before.
#include "sim-server/serve/pacer.hpp"

#include <gtest/gtest.h>

#include "protocol/time_tag.hpp"

namespace splash::sim {
namespace {

class PacerTest : public testing::Test {
 protected:
  PacerClock clock() {
    return {[this] { return now; }, [this] { return now + 1.7e9; },
            [this](double until) {
              slept += until - now;
              now = until;
            }};
  }
  double now = 50.0;  // monotonic [s]
  double slept = 0.0;
};

TEST_F(PacerTest, WaitsForEachFramesMoment) {
  Pacer pacer({}, clock());
  pacer.start();
  for (int i = 1; i <= 10; ++i) {
    now += 0.001;  // computing
    pacer.wait_until(0.004 * i);
    EXPECT_NEAR(now, 50.0 + 0.004 * i, 1.0e-9);
  }
  EXPECT_NEAR(slept, 0.030, 1.0e-9);
  EXPECT_EQ(pacer.counts().behind, 0U);
  EXPECT_NEAR(pacer.unix_origin(), 1.7e9 + 50.0, 1.0e-6);
}

TEST_F(PacerTest, AShortDelayIsCaughtUp) {
  Pacer pacer({}, clock());
  now += 0.054;  // one frame took 54 ms
  pacer.wait_until(0.004);
  EXPECT_EQ(slept, 0.0);
  EXPECT_EQ(pacer.counts().behind, 1U);
  EXPECT_NEAR(pacer.counts().most_behind, 0.050, 1.0e-9);
  for (int i = 2; i <= 20; ++i) {
    now += 0.001;
    pacer.wait_until(0.004 * i);
  }
  EXPECT_NEAR(now, 50.0 + 0.080, 1.0e-9) << "back in step";
  EXPECT_EQ(pacer.counts().slipped, 0.0);
}

TEST_F(PacerTest, ALongDelaySlipsAndLeavesNoBacklog) {
  Pacer pacer({}, clock());
  now += 0.504;
  pacer.wait_until(0.004);
  EXPECT_NEAR(pacer.counts().slipped, 0.5, 1.0e-9);
  EXPECT_NEAR(pacer.unix_origin(), 1.7e9 + 50.5, 1.0e-6);
  now += 0.001;
  pacer.wait_until(0.008);
  EXPECT_NEAR(now, 50.508, 1.0e-9) << "the next frame is paced as any other";
  EXPECT_EQ(pacer.counts().behind, 1U);
}

TEST_F(PacerTest, AMachineTooSlowIsNeverBehindByMoreThanTheLimitAndOneFrame) {
  Pacer pacer({}, clock());
  for (int i = 1; i <= 1000; ++i) {
    now += 0.010;  // 2.5 times too slow
    pacer.wait_until(0.004 * i);
    ASSERT_LE(now + 1.7e9 - (pacer.unix_origin() + 0.004 * i), 0.100 + 1.0e-6);
  }
  EXPECT_LE(pacer.counts().most_behind, 0.100 + 0.010);
  EXPECT_NEAR(pacer.counts().slipped, 6.0, 0.1 + 1.0e-6);  // 10 s of wall for 4 s of water
  EXPECT_EQ(slept, 0.0);
}

TEST_F(PacerTest, TheGraceForgivesWhatNobodyHears) {
  Pacer pacer({}, clock());
  now += 0.0045;
  pacer.wait_until(0.004);
  EXPECT_EQ(pacer.counts().behind, 0U);
  EXPECT_NEAR(pacer.counts().most_behind, 0.0005, 1.0e-9);
}

TEST_F(PacerTest, FasterThanRealTimeNeverWaitsAndTimeFollows) {
  Pacer pacer({.real_time = false}, clock());
  for (int i = 1; i <= 100; ++i) {
    now += 0.001;
    pacer.wait_until(0.004 * i);
    ASSERT_NEAR(pacer.unix_origin() + 0.004 * i, 1.7e9 + now, 1.0e-6);
  }
  EXPECT_EQ(slept, 0.0);
  EXPECT_EQ(pacer.counts().behind, 0U);
}

TEST_F(PacerTest, StartAfterAPauseForgetsIt) {
  Pacer pacer({}, clock());
  pacer.wait_until(1.0);
  now += 30.0;
  pacer.start(1.0);
  now += 0.001;
  pacer.wait_until(1.004);
  EXPECT_NEAR(now, 51.0 + 30.0 + 0.004, 1.0e-9);
  EXPECT_EQ(pacer.counts().behind, 0U);
}

TEST_F(PacerTest, BeingPutAsideBetweenTheClocksDoesNotShiftTheOrigin) {
  int reads = 0;
  auto interrupted = clock();
  interrupted.unix_time = [&] {
    const double value = now + 1.7e9;
    if (++reads <= 2) now += 0.015;  // twice the thread loses the processor here
    return value;
  };
  const Pacer pacer({}, interrupted);
  EXPECT_NEAR(pacer.unix_origin(), 1.7e9 + 50.0, 1.0e-6);
  EXPECT_EQ(reads, 3);
}

TEST(PacerSystem, TheMachinesClocksWaitAtLeastAsLongAsAsked) {
  Pacer pacer;
  const double before = protocol::monotonic_now();
  pacer.start();
  pacer.wait_until(0.020);
  EXPECT_GE(protocol::monotonic_now() - before, 0.020);
}

TEST(RecentPace, ForgetsAStallAfterASecond) {
  RecentPace pace;
  EXPECT_EQ(pace.real_time_factor(), 0.0);
  double wall = 100.0;
  double simulated = 0.0;
  std::int64_t steps = 0;
  const auto run = [&](double seconds) {
    for (const double end = wall + seconds - 1.0e-9; wall < end; wall += 0.01) {
      pace.note(wall, simulated, steps);
      simulated += 0.01;
      steps += 4;
    }
  };
  run(3.0);
  EXPECT_NEAR(pace.real_time_factor(), 1.0, 1.0e-6);
  EXPECT_NEAR(pace.steps_per_second(), 400.0, 1.0e-3);
  wall += 5.0;  // stopped
  run(0.5);
  EXPECT_LT(pace.real_time_factor(), 0.2);
  run(0.6);
  EXPECT_NEAR(pace.real_time_factor(), 1.0, 1.0e-6) << "kept up fully for a second";
  EXPECT_NEAR(pace.steps_per_second(), 400.0, 1.0e-3);
}

TEST(RecentPace, KnowsTheFirstSecond) {
  RecentPace pace;
  pace.note(7.0, 0.0, 0);
  EXPECT_EQ(pace.steps_per_second(), 0.0) << "no time has passed";
  pace.note(7.2, 0.1, 30);
  EXPECT_NEAR(pace.real_time_factor(), 0.5, 1.0e-9);
  EXPECT_NEAR(pace.steps_per_second(), 150.0, 1.0e-6);
}

}  // namespace
}  // namespace splash::sim
