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
#include "tests/sim-server/send/oscpack_reader.hpp"
#include "tests/sim-server/send/sample_events.hpp"

namespace splash::sim {
namespace {

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
  const protocol::TimeTag time{0xE1234567'89ABCDEFULL};
  EXPECT_EQ(build_bundle(time, all_messages()), protocol::encode(time, all_messages()));
}

TEST(LoPacket, IsReadAlikeByOscpackAndByUs) {
  const protocol::TimeTag time{0xE1234567'89ABCDEFULL};
  const auto bytes = build_bundle(time, all_messages());
  const protocol::Packet sent{time, all_messages()};
  EXPECT_EQ(test::read_with_oscpack(bytes), sent);
  EXPECT_EQ(protocol::decode(bytes).packet, sent);
  for (const auto& message : all_messages()) {
    EXPECT_EQ(test::read_with_oscpack(build_message(message)).messages.front(), message);
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
