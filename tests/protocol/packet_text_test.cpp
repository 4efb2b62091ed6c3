// SPDX-License-Identifier: MIT
// The text of /dumpOSC loses no digit.
#include "protocol/control_port.hpp"

#include <gtest/gtest.h>

#include <array>

namespace splash::protocol {
namespace {

TEST(PacketText, ShowsEveryTypeWithAllItsDigits) {
  EXPECT_EQ(
      to_text({"/x", {std::int32_t{-3}, 0.000610F, std::string("a b"), TimeTag{0x100000002}}}),
      "/x ,ifst -3 0.000609999988 \"a b\" 00000001.00000002");
  EXPECT_EQ(to_text({"/status", {}}), "/status ,");
}

TEST(PacketText, ShowsTheTimeOfItsBundle) {
  EXPECT_EQ(to_text({"/x", {}}, TimeTag{1}), "00000000.00000001 /x ,");
}

TEST(PacketText, ShowsBytes) {
  const std::array<std::byte, 3> bytes{std::byte{0x2F}, std::byte{0}, std::byte{0xFA}};
  EXPECT_EQ(to_hexadecimal(bytes), "2f 00 fa");
  EXPECT_EQ(to_hexadecimal({}), "");
}

}  // namespace
}  // namespace splash::protocol
