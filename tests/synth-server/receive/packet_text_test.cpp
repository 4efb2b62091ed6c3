// SPDX-License-Identifier: MIT
#include "synth-server/receive/packet_text.hpp"

#include <gtest/gtest.h>

namespace splash::synth {
namespace {

TEST(PacketText, ShowsEveryType) {
  const protocol::Packet packet{
      std::nullopt,
      {{"/x", {std::int32_t{-3}, 0.000610F, std::string("a b"), protocol::TimeTag{0x100000002}}}}};
  EXPECT_EQ(to_text(packet), "/x -3 0.000609999988 \"a b\" 00000001.00000002");
}

TEST(PacketText, GivesEachMessageALineAndItsTime) {
  const protocol::Packet packet{protocol::TimeTag{1}, {{"/x", {}}, {"/y", {}}}};
  EXPECT_EQ(to_text(packet), "00000000.00000001 /x\n00000000.00000001 /y");
}

TEST(PacketText, ShowsBytes) {
  const std::vector<std::byte> bytes{std::byte{0x2F}, std::byte{0}, std::byte{0xFF}};
  EXPECT_EQ(to_hexadecimal(bytes), "2f 00 ff");
}

}  // namespace
}  // namespace splash::synth
