// SPDX-License-Identifier: MIT
// What the gate lets pass, our decoder, oscpack and liblo read alike.
#include <gtest/gtest.h>

#include <algorithm>
#include <cstdlib>

#include "protocol/control_port.hpp"
#include "tests/protocol/other_readers.hpp"
#include "tests/protocol/random_packets.hpp"

namespace splash::protocol::test {
namespace {

// Of each kind; SPLASH_FUZZ_INPUTS=1000000 for a night.
std::size_t inputs() {
  const char* wanted = std::getenv("SPLASH_FUZZ_INPUTS");
  return wanted == nullptr ? 40000 : std::strtoul(wanted, nullptr, 10);
}

void expect_alike(Bytes packet, LibloReader& liblo) {
  const auto ours = decode(packet);
  ASSERT_EQ(ours.refusal, Refusal::none) << to_hexadecimal(packet);
  ASSERT_EQ(read_with_oscpack(packet), ours.packet) << to_hexadecimal(packet);
  ASSERT_EQ(liblo.read(packet), ours.packet) << to_hexadecimal(packet);
  // One packet has one form: this also compares the sign of zeros, which == does not.
  const auto again = ours.packet.time ? encode(*ours.packet.time, ours.packet.messages)
                                      : encode(ours.packet.messages.at(0));
  ASSERT_TRUE(std::equal(again.begin(), again.end(), packet.begin(), packet.end()))
      << to_hexadecimal(packet);
}

TEST(Readers, ReadLegalPacketsAlike) {
  RandomPackets random(1);
  LibloReader liblo;
  for (std::size_t i = 0; i < inputs() / 2 && !HasFatalFailure(); ++i) {
    expect_alike(random.legal(), liblo);
  }
}

TEST(Readers, ReadAlikeWhatPassesTheGateOfBrokenPackets) {
  RandomPackets random(2);
  LibloReader liblo;
  std::size_t accepted = 0;
  for (std::size_t i = 0; i < inputs() && !HasFatalFailure(); ++i) {
    const auto packet = random.mutated();
    const auto refusal = gate(packet);
    ASSERT_EQ(decode(packet).refusal, refusal);
    if (refusal != Refusal::none) continue;
    ++accepted;
    expect_alike(packet, liblo);
  }
  EXPECT_GT(accepted, inputs() / 10);      // enough to mean something,
  EXPECT_LT(accepted, inputs() * 9 / 10);  // and the mutations do break packets
}

}  // namespace
}  // namespace splash::protocol::test
