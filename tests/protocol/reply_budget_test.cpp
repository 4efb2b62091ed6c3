// SPDX-License-Identifier: MIT
// No datagram of another host draws more bytes than it had, whatever is in it, nor more replies
// than the rate: a burst, then the rate; peers do not share; new ports and hosts do not mint tokens
// for ever.
#include "protocol/reply_budget.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cstdint>
#include <stdexcept>

#include "protocol/address.hpp"
#include "protocol/control.hpp"
#include "protocol/limits.hpp"
#include "protocol/status.hpp"

namespace splash::protocol {
namespace {

using testing::HasSubstr;

constexpr Endpoint kHere{0x7F000102, 9000};  // 127.0.1.2
constexpr Endpoint kAfar{0x0A000005, 9000};
constexpr std::size_t kHeaders = 28;  // of IPv4 and UDP [bytes]

std::size_t size_of(const Message& message) {
  return encode(message).size();
}

TEST(ReplyBudget, AReplyMayBeAsLongAsItsQuestionAndNoLonger) {
  const Message reply = to_message(SynthStatus{});
  ASSERT_EQ(size_of(reply), 116U);
  ReplyBudget enough(kAfar, 116);
  EXPECT_TRUE(enough.fits(reply));
  EXPECT_EQ(enough.take(reply), reply);
  ReplyBudget short_of_it(kAfar, 115);
  EXPECT_FALSE(short_of_it.fits(reply));
  EXPECT_EQ(short_of_it.take(reply), std::nullopt);
}

TEST(ReplyBudget, ItsOwnHostMayDrawWhatItLikes) {
  ReplyBudget budget(kHere, 12);
  for (int i = 0; i < 100; ++i) EXPECT_TRUE(budget.take(to_message(SynthStatus{})));
}

TEST(ReplyBudget, RepliesToOneDatagramCountTogetherWithTheirHeaders) {
  const Message reply = synced(1);
  ASSERT_EQ(size_of(reply), 16U);
  ReplyBudget budget(kAfar, 1296);  // 64 commands /sync in a bundle
  int sent = 0;
  while (sent < 64 && budget.take(reply)) ++sent;
  EXPECT_EQ(sent, 30) << "30 x 44 is 1320, the datagram has 1324 with its own headers";
}

TEST(ReplyBudget, WhatDoesNotFitTakesNothing) {
  ReplyBudget budget(kAfar, 40);
  EXPECT_FALSE(budget.take(to_message(SimStatus{})));
  EXPECT_TRUE(budget.take(pong({1}, {2}, {3}))) << "40 bytes";
  EXPECT_FALSE(budget.take(synced(1)));
}

TEST(ReplyBudget, WhatIsOwedCountsNow) {
  ReplyBudget budget(kAfar, 16 + kHeaders + 20);
  budget.owe(done("/quit"));
  ASSERT_EQ(size_of(done("/quit")), 20U);
  EXPECT_FALSE(budget.fits(done("/notify")));
  EXPECT_TRUE(budget.fits(synced(1)));
}

TEST(ReplyBudget, AReasonIsCutToWhatFits) {
  const Message whole = fail("/sync", "types are ,ss, expected ,i");
  const std::size_t size = size_of(whole);
  for (std::size_t bytes = 0; bytes <= size; bytes += 4) {
    ReplyBudget budget(kAfar, bytes);
    const auto cut = budget.take(whole);
    ASSERT_EQ(cut.has_value(), bytes >= size_of(fail("/sync", ""))) << bytes;
    if (!cut) continue;
    EXPECT_EQ(size_of(*cut), bytes);
    const std::size_t room = bytes - size_of(fail("/sync", "")) + 3;  // a zero closes the text
    EXPECT_EQ(std::get<std::string>(cut->arguments[1]).size(), std::min<std::size_t>(room, 26));
    EXPECT_EQ(cut->arguments[0], whole.arguments[0]);
    EXPECT_THAT(std::get<std::string>(whole.arguments[1]),
                testing::StartsWith(std::get<std::string>(cut->arguments[1])));
  }
  EXPECT_EQ(ReplyBudget(kAfar, size).take(whole), whole);
}

TEST(ReplyBudget, TellsHowLongTheQuestionMustBe) {
  ReplyBudget budget(kAfar, 12);
  EXPECT_EQ(budget.complaint("/status", to_message(SynthStatus{})),
            "asked /status in a datagram of 12 bytes; the reply has 116 bytes and was not sent. "
            "Fill the question up with text to 116 bytes (protocol/README.md, 'Who is answered')");
}

TEST(ReplyBudget, TellsHowLongABundleMustBe) {
  ReplyBudget budget(kAfar, 48);
  ASSERT_TRUE(budget.take(pong({1}, {2}, {3})));
  EXPECT_THAT(budget.complaint("/sync", synced(1)), HasSubstr("behind others"));
  EXPECT_THAT(budget.complaint("/sync", synced(1)), HasSubstr("with text to 84 bytes"));
  ReplyBudget longer(kAfar, 84);
  ASSERT_TRUE(longer.take(pong({1}, {2}, {3})));
  EXPECT_TRUE(longer.take(synced(1))) << "it said what is enough";
}

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
