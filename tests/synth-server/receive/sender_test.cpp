// SPDX-License-Identifier: MIT
#include "synth-server/receive/sender.hpp"

#include <gtest/gtest.h>

#include "protocol/limits.hpp"

namespace splash::synth {
namespace {

TEST(SenderTable, EndsALeaseOnceItHasRunOut) {
  SenderTable table;
  Sender& sender = table.at({INADDR_LOOPBACK, 1});
  sender.present = true;
  sender.heard = 10.0;
  EXPECT_FALSE(table.expire(9.999 + kLease)) << "three heartbeats may be missed";
  EXPECT_TRUE(table.anybody_present());
  EXPECT_TRUE(table.expire(10.001 + kLease));
  EXPECT_FALSE(table.anybody_present());
  EXPECT_FALSE(table.expire(11.0)) << "said once";
}

TEST(SenderTable, WaitsForTheLastOfSeveral) {
  SenderTable table;
  for (const std::uint16_t port : {std::uint16_t{1}, std::uint16_t{2}}) {
    Sender& sender = table.at({INADDR_LOOPBACK, port});
    sender.present = true;
    sender.heard = port;
  }
  EXPECT_FALSE(table.expire(1.5));
  EXPECT_TRUE(table.expire(2.5));
}

TEST(SenderTable, KnowsWhenTheNextLeaseEnds) {
  SenderTable table;
  EXPECT_GT(table.next_expiry(), 1e300) << "nobody is there";
  for (std::uint16_t port = 1; port <= 2; ++port) {
    table.at({INADDR_LOOPBACK, port}).heard = 10.0 - port;
    table.at({INADDR_LOOPBACK, port}).present = true;
  }
  EXPECT_DOUBLE_EQ(table.next_expiry(), 8.0 + kLease);
  EXPECT_FALSE(table.expire(8.0 + kLease)) << "one of two";
  EXPECT_DOUBLE_EQ(table.next_expiry(), 9.0 + kLease) << "at its time, not after it, it was gone";
  EXPECT_TRUE(table.expire(9.0 + kLease));
}

TEST(SenderTable, KeepsTheCountsOfThoseItForgets) {
  SenderTable table;
  for (std::uint16_t port = 1; port <= 100; ++port) {
    Sender& sender = table.at({INADDR_LOOPBACK, port});
    sender.heard = port;
    sender.sequence.observe({1, 0, 0, 0.0F});
    sender.sequence.observe({1, 3, 0, 0.0F});
  }
  EXPECT_LE(table.all().size(), 16U);
  EXPECT_EQ(table.find({INADDR_LOOPBACK, 1}), nullptr);
  EXPECT_NE(table.find({INADDR_LOOPBACK, 100}), nullptr);
  EXPECT_EQ(table.totals().received, 200U);
  EXPECT_EQ(table.totals().lost, 200U);
}

}  // namespace
}  // namespace splash::synth
