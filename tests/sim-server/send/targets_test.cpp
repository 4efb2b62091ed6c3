// SPDX-License-Identifier: MIT
// Fixed targets stay, subscribers come, renew, expire and are bounded.
#include "sim-server/send/targets.hpp"

#include <gtest/gtest.h>

#include <array>
#include <cstdint>

#include "tests/sim-server/send/peer.hpp"

namespace splash::sim {
namespace {

protocol::Endpoint port(std::uint16_t number) {
  return {.port = number};
}

class TargetsTest : public testing::Test {
 protected:
  double now = 100.0;
  Targets targets{{port(1), port(2), port(1)}, [this] { return now; }};
  protocol::UdpSocket socket{protocol::Endpoint{}};
};

TEST_F(TargetsTest, ATargetNamedTwiceIsOne) {
  EXPECT_EQ(targets.list().size(), 2U);
}

TEST_F(TargetsTest, SubscribersExpireUnlessTheySpeak) {
  test::Peer quiet;
  test::Peer lively;
  EXPECT_TRUE(targets.subscribe(quiet.endpoint()));
  EXPECT_TRUE(targets.subscribe(lively.endpoint()));
  now += 0.75 * kSubscriptionLease;
  targets.renew(lively.endpoint());
  now += 0.75 * kSubscriptionLease;
  const std::array<std::byte, 4> packet{};
  targets.send(socket, packet);
  EXPECT_TRUE(quiet.silent());
  EXPECT_TRUE(lively.bytes().has_value());
  EXPECT_EQ(targets.list().size(), 3U);  // two fixed, which do not expire, and the lively one
}

TEST_F(TargetsTest, EachGetsTheStreamsThatItAskedFor) {
  const std::array<std::byte, 4> packet{};
  test::Peer feels;
  EXPECT_FALSE(targets.wants(kForceStream));
  EXPECT_TRUE(targets.subscribe(feels.endpoint(), kForceStream));
  EXPECT_TRUE(targets.wants(kForceStream));
  targets.send(socket, packet);
  EXPECT_TRUE(feels.silent()) << "events";
  targets.send(socket, packet, kForceStream);
  EXPECT_TRUE(feels.bytes().has_value());
  now += 1.5 * kSubscriptionLease;
  EXPECT_FALSE(targets.wants(kForceStream)) << "it is gone";
}

TEST_F(TargetsTest, AWordOnTheEventsGoesToWhoAskedForThemAlone) {
  const std::array<std::byte, 4> packet{};
  test::Peer hears;
  test::Peer feels;
  EXPECT_TRUE(targets.subscribe(hears.endpoint()));
  EXPECT_TRUE(targets.subscribe(feels.endpoint(), kForceStream));
  targets.tell(socket, packet);
  EXPECT_TRUE(hears.bytes().has_value());
  EXPECT_TRUE(feels.silent());
  for (const Target& target : targets.list()) EXPECT_TRUE(!target.fixed || target.sent == 0U);
}

TEST_F(TargetsTest, ATargetNamedAtStartGetsForcesForALeaseOnly) {
  EXPECT_TRUE(targets.subscribe(port(1), kForceStream));
  EXPECT_TRUE(targets.wants(kForceStream));
  EXPECT_TRUE(targets.wants(kEventStream));
  now += 1.5 * kSubscriptionLease;
  EXPECT_FALSE(targets.wants(kForceStream));
  EXPECT_TRUE(targets.wants(kEventStream));
  EXPECT_TRUE(targets.subscribe(port(1), kForceStream));
  EXPECT_FALSE(targets.unsubscribe(port(1)));
  EXPECT_FALSE(targets.wants(kForceStream));
}

TEST_F(TargetsTest, RenewingDoesNotSubscribe) {
  targets.renew(port(77));
  EXPECT_EQ(targets.list().size(), 2U);
}

TEST_F(TargetsTest, UnsubscribingLeavesFixedTargets) {
  EXPECT_FALSE(targets.unsubscribe(port(1)));
  EXPECT_TRUE(targets.subscribe(port(3)));
  EXPECT_TRUE(targets.unsubscribe(port(3)));
  EXPECT_FALSE(targets.unsubscribe(port(3)));
  EXPECT_EQ(targets.list().size(), 2U);
}

TEST_F(TargetsTest, IsBoundedAndRoomReturnsWithTime) {
  for (std::uint16_t i = 0; i < kMaxSubscribers; ++i) {
    EXPECT_TRUE(targets.subscribe(port(static_cast<std::uint16_t>(1000 + i))));
  }
  EXPECT_FALSE(targets.subscribe(port(2000)));
  EXPECT_TRUE(targets.subscribe(port(1000))) << "a known one may renew";
  now += kSubscriptionLease + 1.0;
  EXPECT_TRUE(targets.subscribe(port(2000)));
}

TEST(SendingEndpoint, StaysOnLoopbackUnlessATargetIsElsewhere) {
  EXPECT_EQ(sending_endpoint({}).address, INADDR_LOOPBACK);
  EXPECT_EQ(sending_endpoint({port(1), {.address = 0x7F000102U, .port = 1}}).address,
            INADDR_LOOPBACK);
  EXPECT_EQ(sending_endpoint({port(1), {.address = 0x0A000001U, .port = 1}}).address, INADDR_ANY);
  // Who may ask from another host must be reached there.
  EXPECT_EQ(sending_endpoint({port(1)}, {.address = 0x7F000102U}).address, INADDR_LOOPBACK);
  EXPECT_EQ(sending_endpoint({port(1)}, {.address = INADDR_ANY}).address, INADDR_ANY);
  EXPECT_EQ(sending_endpoint({}, {.address = 0x0A000001U}).address, INADDR_ANY);
}

}  // namespace
}  // namespace splash::sim
