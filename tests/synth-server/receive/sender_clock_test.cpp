// SPDX-License-Identifier: MIT
#include "synth-server/receive/sender_clock.hpp"

#include <gtest/gtest.h>

namespace splash::synth {
namespace {

constexpr double kNow = 1.8e9;
constexpr double kTravel = 0.0005;

/// Bundles of a sender whose clock is `ahead` of ours, each on its way for kTravel.
void hear(SenderClock& clock, double ahead, double from = 0.0) {
  for (int i = 0; i < 20; ++i) {
    const double sent = from + 100.0 + 0.1 * i;
    clock.observe(sent + ahead, sent + kTravel, kNow);
  }
}

void ping(SenderClock& clock, double ahead, double at) {
  clock.pong(at, at + kTravel + ahead, at + 2 * kTravel + ahead, at + 3 * kTravel);
}

TEST(SenderClock, LeavesASharedClockAlone) {
  for (const bool same_host : {true, false}) {
    SenderClock clock(same_host);
    hear(clock, 0.0);
    EXPECT_EQ(clock.correction(kNow), 0.0);
    for (int i = 0; i < 10; ++i) ping(clock, 0.0, kNow + i);
    EXPECT_EQ(clock.correction(kNow + 10.0), 0.0);
  }
}

TEST(SenderClock, ASleepingReceiverIsNotAWrongClock) {
  SenderClock clock(true);
  hear(clock, 0.0);
  clock.observe(103.0, 108.0, kNow);  // waited five seconds in the socket
  EXPECT_EQ(clock.correction(kNow), 0.0);
}

TEST(SenderClock, GoesByTheQuickestBundleWithoutPings) {
  for (const double ahead : {3600.0, -3600.0}) {
    for (const bool same_host : {true, false}) {
      SenderClock clock(same_host);
      hear(clock, ahead);
      EXPECT_NEAR(clock.correction(kNow), kTravel - ahead, 1e-6) << ahead;
    }
  }
  SenderClock other_host(false);
  hear(other_host, 0.300);
  EXPECT_NEAR(other_host.correction(kNow), kTravel - 0.300, 1e-6);
}

TEST(SenderClock, GoesByPingsWhereTheyAreAnswered) {
  for (const double ahead : {3600.0, -3600.0, 0.020, -0.020}) {
    SenderClock clock(false);
    hear(clock, ahead);
    for (int i = 0; i < 10; ++i) ping(clock, ahead, kNow + 0.1 * i);
    EXPECT_NEAR(clock.correction(kNow + 1.0), -ahead, 1e-4) << ahead;
  }
}

/// Bundles from the step of the sender's clock on until it is noticed, a tenth of a second apart.
int bundles_until_noticed(double step, bool pings) {
  SenderClock clock(false);
  hear(clock, 0.0);
  for (int i = 0; pings && i < 10; ++i) ping(clock, 0.0, kNow + 0.1 * i);
  for (int i = 1; i < 100; ++i) {
    const double sent = 103.0 + 0.1 * i;
    if (!clock.observe(sent + step, sent + kTravel, kNow + 3.0)) continue;
    EXPECT_NEAR(clock.correction(kNow + 3.0), kTravel - step, 1e-6);
    return i;
  }
  return 0;
}

TEST(SenderClock, NoticesAStepBeforeAnyPingDoes) {
  for (const bool pings : {true, false}) {
    for (const double ahead : {3600.0, 0.5, 0.03}) {
      EXPECT_EQ(bundles_until_noticed(ahead, pings), 1) << "it came before it was sent";
    }
    for (const double back : {-3600.0, -0.5, -0.08}) {
      EXPECT_EQ(bundles_until_noticed(back, pings), 3);
    }
    for (const double small : {0.015, -0.05}) EXPECT_EQ(bundles_until_noticed(small, pings), 0);
  }
}

TEST(SenderClock, AHeapOfBundlesThatWereHeldUpIsNoStep) {
  SenderClock clock(false);
  hear(clock, 0.0);
  for (int i = 0; i < 20; ++i) {  // sent every 10 ms, let through together
    EXPECT_FALSE(clock.observe(103.0 + 0.01 * i, 103.4 + 1e-4 * i, kNow));
  }
  for (int i = 0; i < 20; ++i) {  // the same again, slowly: each later than the one before
    EXPECT_FALSE(clock.observe(104.0 + 0.1 * i, 104.0 + 0.2 * i, kNow));
  }
  EXPECT_EQ(clock.correction(kNow), 0.0);
}

TEST(SenderClock, FollowsASlowDrift) {
  SenderClock clock(true);
  for (int i = 0; i < 100; ++i) {  // 100 s at 100 ppm, an hour ahead
    hear(clock, 3600.0 + 1e-4 * i, i);
  }
  EXPECT_NEAR(clock.correction(kNow), kTravel - 3600.0 - 0.0099, 0.0015);
}

TEST(SenderClock, ARestartForgetsTheDelays) {
  SenderClock clock(true);
  hear(clock, 3600.0);
  ASSERT_NE(clock.correction(kNow), 0.0);
  clock.restart();
  EXPECT_EQ(clock.correction(kNow), 0.0);
}

}  // namespace
}  // namespace splash::synth
