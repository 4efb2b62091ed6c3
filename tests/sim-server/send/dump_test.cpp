// SPDX-License-Identifier: MIT
// The text of /dumpOSC loses no digit.
#include "sim-server/listen/dump.hpp"

#include <gtest/gtest.h>

#include <array>
#include <cstddef>
#include <string>

namespace splash::sim {
namespace {

TEST(Dump, PrintsEveryTypeWithAllItsDigits) {
  EXPECT_EQ(
      to_text({"/x", {-7, 0.1F, std::string("word"), protocol::TimeTag{0x00000001'80000000ULL}}}),
      "/x ,ifst -7 0.100000001 \"word\" 0000000180000000");
  EXPECT_EQ(to_text({"/status", {}}), "/status ,");
}

TEST(Dump, PrintsBytes) {
  const std::array<std::byte, 3> bytes{std::byte{0x2F}, std::byte{0x00}, std::byte{0xFA}};
  EXPECT_EQ(to_hexadecimal(bytes), "2f 00 fa");
  EXPECT_EQ(to_hexadecimal({}), "");
}

}  // namespace
}  // namespace splash::sim
