// SPDX-License-Identifier: MIT
// liblo's bytes are ours bit by bit, and oscpack reads from them what was put in.
#include "sim-server/send/lo_packet.hpp"

#include <gtest/gtest.h>

#include <stdexcept>
#include <string>
#include <vector>

#include "protocol/control.hpp"
#include "protocol/limits.hpp"
#include "protocol/status.hpp"
#include "tests/protocol/other_readers.hpp"
#include "tests/protocol/random_packets.hpp"
#include "tests/sim-server/send/sample_events.hpp"

namespace splash::sim {
namespace {

using protocol::test::read_with_oscpack;

constexpr protocol::TimeTag kTime{0xE1234567'89ABCDEFULL};

/// One message of each kind that the simulator sends.
std::vector<protocol::Message> all_messages() {
  return {protocol::to_message(protocol::Frame{
              .session = 16777215, .sequence = 7, .step = 123456, .delay_ms = 9.5F}),
          protocol::to_message(test::impact(3, 0.0).event),
          protocol::to_message(test::bubble(16777215, 0.0).event),
          protocol::to_message(test::cavity(0, 0.0).event),
          protocol::to_message(protocol::SimStatus{.particles = 15000, .steps = 99}),
          protocol::done("/notify", 1),
          protocol::done("/clearSched"),
          protocol::fail("/nosuch", "unknown command"),
          protocol::synced(-2147483647),
          protocol::pong({0xE0000000FFFFFFFFULL}, {1}, {0xE000000100000000ULL}),
          protocol::version_reply(protocol::kSimProgram)};
}

TEST(LoPacket, BuildsTheSameBytesAsOurEncoder) {
  for (const auto& message : all_messages()) {
    EXPECT_EQ(build_message(message), protocol::encode(message)) << message.address;
  }
  EXPECT_EQ(build_bundle(kTime, all_messages()), protocol::encode(kTime, all_messages()));
}

TEST(LoPacket, BuildsTheSameBytesOfAnyMessages) {
  protocol::test::RandomPackets random(3);
  for (int i = 0; i < 10'000; ++i) {
    const auto message = random.message();
    ASSERT_EQ(build_message(message), protocol::encode(message)) << i;
    const auto time = random.time();
    const auto messages = random.messages();
    ASSERT_EQ(build_bundle(time, messages), protocol::encode(time, messages)) << i;
  }
}

TEST(LoPacket, IsReadAlikeByOscpackAndByUs) {
  const auto bytes = build_bundle(kTime, all_messages());
  const protocol::Packet sent{kTime, all_messages()};
  EXPECT_EQ(read_with_oscpack(bytes), sent);
  EXPECT_EQ(protocol::decode(bytes).packet, sent);
  for (const auto& message : all_messages()) {
    EXPECT_EQ(read_with_oscpack(build_message(message)), (protocol::Packet{{}, {message}}));
  }
}

TEST(LoPacket, RefusesMoreThanOneDatagram) {
  const std::vector<protocol::Message> fitting(26,
                                               protocol::to_message(test::bubble(0, 0.0).event));
  EXPECT_EQ(build_bundle({1}, fitting).size(), 16U + 26U * 56U);  // 1472: to the last byte
  auto too_many = fitting;
  too_many.push_back({"/x", {}});
  EXPECT_THROW(static_cast<void>(build_bundle({1}, too_many)), std::length_error);
  const std::vector<protocol::Message> too_small_to_be_long(65, protocol::Message{"/x", {}});
  EXPECT_THROW(static_cast<void>(build_bundle({1}, too_small_to_be_long)), std::length_error);
  EXPECT_THROW(static_cast<void>(build_message({"/x", {std::string(1500, 'a')}})),
               std::length_error);
}

}  // namespace
}  // namespace splash::sim
