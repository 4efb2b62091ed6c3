// SPDX-License-Identifier: MIT
// Packets that crash, hang or stall OSC libraries of the field are refused for the right reason,
// and the legal packets next to them are not.
#include "protocol/gate.hpp"

#include <gtest/gtest.h>

#include <ctime>
#include <set>
#include <string>

#include "protocol/limits.hpp"
#include "protocol/message.hpp"
#include "tests/protocol/killers.hpp"
#include "tests/protocol/raw_packet.hpp"

namespace splash::protocol::test {
namespace {

std::vector<Killer> legal_packets() {
  const std::string sixteen = "," + std::string(16, 'i');
  return {
      {"an empty bundle: some use it as a heartbeat", bundle_head(), Refusal::none},
      {"no arguments", message("/status", ","), Refusal::none},
      {"all four types",
       message("/a", ",ifst", word(1) + word(0x3f800000) + padded("xyz") + word(1) + word(2)),
       Refusal::none},
      {"the smallest denormal, largest float and minus zero",
       message("/a", ",fff", word(1) + word(0x7f7fffff) + word(0x80000000)), Refusal::none},
      {"24 arguments", message("/a", "," + std::string(24, 'i'), Raw(96)), Refusal::none},
      {"address of 64 characters", message("/" + std::string(63, 'a'), ","), Refusal::none},
      {"text of 64 characters", message("/a", ",s", padded(std::string(64, '~'))), Refusal::none},
      {"empty text", message("/a", ",s", padded("")), Refusal::none},
      {"every character an address may have", message("/azAZ09/_.-", ",i", word(0xffffffff)),
       Refusal::none},
      {"64 messages", bundle_head() + repeated(element(message("/a", ",")), 64), Refusal::none},
      {"a time tag in 1900", bundle_head(2) + element(message("/impact", ",i", word(7))),
       Refusal::none},
      {"a time tag in 2100",
       bundle_head(0x76c0a580ULL << 32U) + element(message("/impact", ",i", word(7))),
       Refusal::none},
      {"1472 bytes",
       bundle_head() + repeated(element(message("/a", sixteen, Raw(64))), 15) +
           element(message("/" + std::string(63, 'a'), ",")),
       Refusal::none},
  };
}

TEST(Gate, TellsKillersByTheirReason) {
  for (const Killer& killer : killers()) {
    EXPECT_EQ(describe(gate(killer.bytes)), describe(killer.why)) << killer.name;
  }
}

TEST(Gate, LetsLegalPacketsPass) {
  for (const Killer& legal : legal_packets()) {
    EXPECT_EQ(describe(gate(legal.bytes)), describe(legal.why)) << legal.name;
  }
  EXPECT_EQ(legal_packets().back().bytes.size(), kMaxDatagram);
}

TEST(Gate, EveryReasonIsTriedAndHasWords) {
  std::set<Refusal> tried;
  for (const Killer& killer : killers()) tried.insert(killer.why);
  EXPECT_EQ(tried.size(), static_cast<std::size_t>(Refusal::count_));
  std::set<std::string_view> words;
  for (const auto reason : tried) words.insert(describe(reason));
  EXPECT_EQ(words.size(), tried.size());
}

/// Of this thread alone: other programs may be running [s].
double processor_time() {
  timespec now{};
  clock_gettime(CLOCK_THREAD_CPUTIME_ID, &now);
  return static_cast<double>(now.tv_sec) + 1e-9 * static_cast<double>(now.tv_nsec);
}

// The longest packet costs microseconds; a thousand times as much still means linear work.
TEST(Gate, NoPacketStallsItOrTheDecoder) {
  for (const auto& list : {killers(), legal_packets()}) {
    for (const Killer& one : list) {
      double least = 1.0;
      for (int i = 0; i < 5; ++i) {
        const double start = processor_time();
        (void)decode(one.bytes);
        least = std::min(least, processor_time() - start);
      }
      EXPECT_LT(least, 1e-3) << one.name;
    }
  }
}

// Every prefix of a legal packet is refused: nothing is ever accepted half.
TEST(Gate, RefusesEveryPrefix) {
  const Raw whole = bundle_head() + element(message("/a", ",ifs", word(1) + word(2) + padded("x")));
  ASSERT_EQ(gate(whole), Refusal::none);
  for (std::size_t size = 0; size < whole.size(); ++size) {
    if (size == 16) continue;  // the empty bundle
    EXPECT_NE(gate(Bytes(whole).first(size)), Refusal::none) << size;
  }
}

}  // namespace
}  // namespace splash::protocol::test
