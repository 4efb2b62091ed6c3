// SPDX-License-Identifier: MIT
// oscpack behind the gate reads what our own decoder reads, and survives what kills it alone.
#include "synth-server/receive/oscpack_reader.hpp"

#include <gtest/gtest.h>

#include "tests/protocol/killers.hpp"

namespace splash::synth {
namespace {

using protocol::Message;

std::vector<Message> sample_messages() {
  return {protocol::to_message(protocol::Frame{1, 2, 3, 4.5F}),
          protocol::to_message(protocol::Impact{1, 0, 2.0F, 1.5F, {0.1F, 0.2F, 0.3F}, 3.0F}),
          protocol::to_message(protocol::Bubble{2, -1, 0.00061F, 0.05F, {-1.0F, 0.0F, 0.1F}, 0.0F}),
          {"/ping", {protocol::TimeTag{0x0123456789ABCDEF}}},
          {"/done", {std::string("/quit"), std::int32_t{-5}}},
          {"/status", {}}};
}

TEST(OscpackReader, ReadsWhatOurDecoderReads) {
  for (const Message& message : sample_messages()) {
    const auto bytes = protocol::encode(message);
    const auto read = read_packet(bytes);
    EXPECT_EQ(read.refusal, protocol::Refusal::none) << message.address;
    EXPECT_EQ(read.packet, protocol::decode(bytes).packet) << message.address;
    ASSERT_EQ(read.packet.messages.size(), 1U);
    EXPECT_EQ(read.packet.messages[0], message);
  }
  const auto bundle = protocol::encode(protocol::TimeTag{77}, sample_messages());
  const auto read = read_packet(bundle);
  EXPECT_EQ(read.packet, protocol::decode(bundle).packet);
  EXPECT_EQ(read.packet.messages, sample_messages());
}

TEST(OscpackReader, ReadsOfTheKillersWhatTheGateLetsPass) {
  for (const protocol::test::Killer& killer : protocol::test::killers()) {
    const auto read = read_packet(killer.bytes);
    EXPECT_EQ(read.refusal, killer.why) << killer.name;
    EXPECT_EQ(read.packet, protocol::decode(killer.bytes).packet) << killer.name;
  }
}

}  // namespace
}  // namespace splash::synth
