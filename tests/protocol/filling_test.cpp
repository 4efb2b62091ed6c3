// SPDX-License-Identifier: MIT
#include "protocol/reply_budget.hpp"

#include <gtest/gtest.h>

#include <stdexcept>

#include "protocol/address.hpp"
#include "protocol/control.hpp"
#include "protocol/limits.hpp"
#include "protocol/status.hpp"

namespace splash::protocol {
namespace {

TEST(Filling, ReachesEveryLengthWithFourBytesMoreAtMost) {
  for (const Message& command : {Message{"/status", {}}, Message{"/sync", {7}}, ping({1})}) {
    for (std::size_t bytes = 0; bytes <= 1052; ++bytes) {
      const Message filled = filled_up(command, bytes);
      const std::size_t size = encode(filled).size();
      ASSERT_GE(size, bytes);
      ASSERT_LE(size, std::max(encode(command).size(), (bytes + 3) / 4 * 4 + 4));
      ASSERT_FALSE(violation(filled)) << *violation(filled);
      ASSERT_TRUE(
          std::equal(command.arguments.begin(), command.arguments.end(), filled.arguments.begin()));
    }
  }
}

TEST(Filling, APingIsAsLongAsItsPong) {
  EXPECT_EQ(encode(filled_up(ping({1}), 40)).size(), 40U);
  EXPECT_EQ(encode(pong({1}, {2}, {3})).size(), 40U);
}

TEST(Filling, LeavesWhatIsLongEnough) {
  EXPECT_EQ(filled_up(ping({1}), 20), ping({1}));
}

TEST(Filling, HasRoomForFieldsThatAStatusGetsOneDay) {
  for (const Message& reply : {to_message(SynthStatus{}), to_message(SimStatus{})}) {
    EXPECT_GE(kFilledQuestion, 2 * encode(reply).size());
  }
}

TEST(Filling, RefusesWhatNoMessageHolds) {
  EXPECT_THROW((void)filled_up({"/status", {}}, 2 * kMaxDatagram), std::length_error);
}

}  // namespace
}  // namespace splash::protocol
