// SPDX-License-Identifier: MIT
// A burst, then the rate; peers do not share; new ports and hosts do not mint tokens for ever.
#include "protocol/reply_budget.hpp"

#include <gtest/gtest.h>

#include <cstdint>

namespace splash::protocol {
namespace {

constexpr double kRate = 20.0;
constexpr int kBurst = 40;

Endpoint port(int number) {
  return {.port = static_cast<std::uint16_t>(number)};
}

int allowed(RateLimit& limit, const Endpoint& peer, int tries, double now) {
  int count = 0;
  for (int i = 0; i < tries; ++i) count += limit.allow(peer, now) ? 1 : 0;
  return count;
}

TEST(RateLimit, GivesABurstThenTheRate) {
  RateLimit limit(kRate, kBurst);
  EXPECT_EQ(allowed(limit, port(1), 1000, 10.0), kBurst);
  EXPECT_EQ(allowed(limit, port(1), 1000, 10.5), 10);
  EXPECT_EQ(allowed(limit, port(1), 1000, 1000.0), kBurst);
}

TEST(RateLimit, OneWhoFloodsTakesNothingFromOthers) {
  RateLimit limit(kRate, kBurst);
  allowed(limit, port(1), 1000, 10.0);
  EXPECT_TRUE(limit.allow(port(2), 10.0)) << "each port of this host is a peer";
  EXPECT_TRUE(limit.allow({0x0A000005, 1}, 10.0));
}

TEST(RateLimit, ThePortsOfAnotherHostAreOnePeer) {
  RateLimit limit(kRate, kBurst);
  int count = 0;
  for (std::uint16_t i = 0; i < 1000; ++i) count += limit.allow({0x0A000005, i}, 10.0) ? 1 : 0;
  EXPECT_EQ(count, kBurst);
}

TEST(RateLimit, NewPeersDoNotMintTokens) {
  RateLimit limit(kRate, kBurst);
  for (int i = 0; i < static_cast<int>(RateLimit::kMaxPeers); ++i) {
    allowed(limit, port(i), 1000, 10.0);
  }
  int count = 0;
  for (int i = 1000; i < 3000; ++i) count += limit.allow(port(i), 10.0) ? 1 : 0;
  EXPECT_EQ(count, 0);
  EXPECT_TRUE(limit.allow(port(5000), 11.0)) << "after a rest there is room";
}

TEST(RateLimit, AClockThatStandsStillOrStepsBackGivesNothing) {
  RateLimit limit(kRate, kBurst);
  allowed(limit, port(1), 1000, 10.0);
  EXPECT_FALSE(limit.allow(port(1), 5.0));
  EXPECT_FALSE(limit.allow(port(1), 5.0));
}

}  // namespace
}  // namespace splash::protocol
