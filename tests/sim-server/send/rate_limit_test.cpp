// SPDX-License-Identifier: MIT
// A burst, then the rate; peers do not share; new ports do not mint tokens for ever.
#include "sim-server/listen/rate_limit.hpp"

#include <gtest/gtest.h>

#include <cstdint>

namespace splash::sim {
namespace {

protocol::Endpoint port(int number) {
  return {.port = static_cast<std::uint16_t>(number)};
}

int allowed(RateLimit& limit, const protocol::Endpoint& peer, int tries, double now) {
  int count = 0;
  for (int i = 0; i < tries; ++i) count += limit.allow(peer, now) ? 1 : 0;
  return count;
}

TEST(RateLimit, GivesABurstThenTheRate) {
  RateLimit limit;
  EXPECT_EQ(allowed(limit, port(1), 1000, 10.0), static_cast<int>(RateLimit::kBurst));
  EXPECT_EQ(allowed(limit, port(1), 1000, 10.5), static_cast<int>(0.5 * RateLimit::kRate));
  EXPECT_EQ(allowed(limit, port(1), 1000, 1000.0), static_cast<int>(RateLimit::kBurst));
}

TEST(RateLimit, OneWhoFloodsTakesNothingFromOthers) {
  RateLimit limit;
  allowed(limit, port(1), 1000, 10.0);
  EXPECT_TRUE(limit.allow(port(2), 10.0));
}

TEST(RateLimit, NewPortsDoNotMintTokens) {
  RateLimit limit;
  for (int i = 0; i < static_cast<int>(RateLimit::kMaxPeers); ++i) {
    allowed(limit, port(i), 1000, 10.0);
  }
  int count = 0;
  for (int i = 1000; i < 3000; ++i) count += limit.allow(port(i), 10.0) ? 1 : 0;
  EXPECT_EQ(count, 0);
  EXPECT_TRUE(limit.allow(port(5000), 11.0)) << "after a rest there is room";
}

TEST(RateLimit, AClockThatStandsStillOrStepsBackGivesNothing) {
  RateLimit limit;
  allowed(limit, port(1), 1000, 10.0);
  EXPECT_FALSE(limit.allow(port(1), 5.0));
  EXPECT_FALSE(limit.allow(port(1), 5.0));
}

}  // namespace
}  // namespace splash::sim
