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
    clock.observe(sent + ahead, sent + kTravel);
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
  clock.observe(103.0, 108.0);  // waited five seconds in the socket
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
