// SPDX-License-Identifier: MIT
#include "synth-server/receive/reply_limit.hpp"

#include <gtest/gtest.h>

namespace splash::synth {
namespace {

TEST(ReplyLimit, AllowsTenAtOnceAndTenASecond) {
  ReplyLimit limit;
  int allowed = 0;
  for (int i = 0; i < 1000; ++i) allowed += limit.allow(1, 5.0) ? 1 : 0;
  EXPECT_EQ(allowed, 10);
  allowed = 0;
  for (int i = 0; i < 10000; ++i) allowed += limit.allow(1, 5.0 + 1e-3 * i) ? 1 : 0;
  EXPECT_NEAR(allowed, 100, 1);
}

TEST(ReplyLimit, CountsEachHostAlone) {
  ReplyLimit limit;
  for (int i = 0; i < 20; ++i) (void)limit.allow(1, 5.0);
  EXPECT_FALSE(limit.allow(1, 5.0));
  EXPECT_TRUE(limit.allow(2, 5.0));
}

TEST(ReplyLimit, ForgetsTheOldestOfManyHosts) {
  ReplyLimit limit;
  for (std::uint32_t host = 0; host < 100000; ++host) {
    EXPECT_TRUE(limit.allow(host, 1e-5 * host));
  }
}

}  // namespace
}  // namespace splash::synth
