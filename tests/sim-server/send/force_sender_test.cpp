// SPDX-License-Identifier: MIT
// Forces as subscribers get them: a frame, then four messages of each body, five bodies in a
// bundle, each bundle with a number of its own; a body whose numbers are none is left out.
#include "sim-server/send/force_sender.hpp"

#include <gtest/gtest.h>

#include <limits>

#include "protocol/limits.hpp"
#include "protocol/time_tag.hpp"
#include "tests/sim-server/send/peer.hpp"

namespace splash::sim {
namespace {

ForceReading reading_of(std::int32_t body) {
  const double b = body;
  return {.body = body,
          .at = {b, 1.0, 2.0, 0.0, 0.0, 0.6, 0.8},
          .twist = {0.25, 0.5, 0.75, 1.0, 1.25, 1.5},
          .force = {b + 0.5, -2.0, 3.0, 0.125, 0.25, 0.375},
          .rate = {-4.0, -5.0, -6.0, -0.5, -0.25, -0.125}};
}

std::vector<double> numbers(const protocol::Message& message) {
  std::vector<double> all;
  for (std::size_t i = 1; i < message.arguments.size(); ++i) {
    all.push_back(static_cast<double>(std::get<float>(message.arguments[i])));
  }
  return all;
}

class Forces : public testing::Test {
 protected:
  Forces() { EXPECT_TRUE(targets_.subscribe(peer_.endpoint(), kForceStream)); }

  Targets targets_{{}};
  protocol::UdpSocket socket_{protocol::Endpoint{}};
  ForceSender sender_{targets_, socket_, 77};
  test::Peer peer_;
};

TEST_F(Forces, AreToldBehindTheirFrame) {
  const double end = protocol::unix_now() + 0.01;
  sender_.send(42, end, force_bundles({reading_of(3)}));
  const auto packet = peer_.packet();
  ASSERT_TRUE(packet.has_value());
  ASSERT_TRUE(packet->time.has_value());
  EXPECT_NEAR(protocol::to_unix_seconds(*packet->time), end, 1.0e-6);
  ASSERT_EQ(packet->messages.size(), 5U);
  const protocol::Message& frame = packet->messages[0];
  EXPECT_EQ(frame.address, "/frame");
  EXPECT_EQ(std::get<std::int32_t>(frame.arguments[0]), 77);
  EXPECT_EQ(std::get<std::int32_t>(frame.arguments[2]), 42);
  EXPECT_NEAR(std::get<float>(frame.arguments[3]), 10.0F, 9.0F);
  const std::vector<std::pair<std::string, std::vector<double>>> wanted = {
      {"/body/at", {3.0, 1.0, 2.0, 0.0, 0.0, 0.6F, 0.8F}},
      {"/body/twist", {0.25, 0.5, 0.75, 1.0, 1.25, 1.5}},
      {"/force", {3.5, -2.0, 3.0, 0.125, 0.25, 0.375}},
      {"/force/rate", {-4.0, -5.0, -6.0, -0.5, -0.25, -0.125}}};
  for (std::size_t i = 0; i < wanted.size(); ++i) {
    const protocol::Message& message = packet->messages[i + 1];
    EXPECT_EQ(message.address, wanted[i].first);
    EXPECT_EQ(std::get<std::int32_t>(message.arguments[0]), 3);
    EXPECT_EQ(numbers(message), wanted[i].second);
  }
}

TEST_F(Forces, OfManyBodiesComeFiveInABundle) {
  std::vector<ForceReading> readings;
  for (std::int32_t body = 0; body < 12; ++body) readings.push_back(reading_of(body));
  sender_.send(1, protocol::unix_now(), force_bundles(readings));
  EXPECT_EQ(sender_.bundles(), 3U);
  std::int32_t next = 0;
  for (const std::size_t bodies : {5U, 5U, 2U}) {
    const auto raw = peer_.bytes();
    ASSERT_TRUE(raw.has_value());
    EXPECT_LE(raw->size(), protocol::kMaxDatagram);
    const auto decoded = protocol::decode(*raw);
    ASSERT_EQ(decoded.packet.messages.size(), 1 + 4 * bodies);
    EXPECT_EQ(std::get<std::int32_t>(decoded.packet.messages[0].arguments[1]), next++);
  }
}

TEST_F(Forces, OfABodyWhoseNumbersAreNoneAreLeftOut) {
  ForceReading broken = reading_of(1);
  broken.force[2] = std::numeric_limits<double>::quiet_NaN();
  sender_.send(1, protocol::unix_now(), force_bundles({reading_of(0), broken, reading_of(2)}));
  const auto packet = peer_.packet();
  ASSERT_TRUE(packet.has_value());
  ASSERT_EQ(packet->messages.size(), 9U);
  EXPECT_EQ(std::get<std::int32_t>(packet->messages[5].arguments[0]), 2);
  sender_.send(2, protocol::unix_now(), force_bundles({broken}));
  EXPECT_TRUE(peer_.silent()) << "a frame alone says nothing";
}

TEST_F(Forces, ComeToThoseAloneWhoAskedForThem) {
  test::Peer events;
  EXPECT_TRUE(targets_.subscribe(events.endpoint(), kEventStream));
  sender_.send(1, protocol::unix_now(), force_bundles({reading_of(0)}));
  EXPECT_TRUE(peer_.bytes().has_value());
  EXPECT_TRUE(events.silent());
}

}  // namespace
}  // namespace splash::sim
