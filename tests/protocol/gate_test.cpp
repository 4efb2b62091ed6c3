// SPDX-License-Identifier: MIT
// The killers: packets that crash, hang or stall OSC libraries of the field, each with the reason
// for which the gate must refuse it; and the legal packets next to them, which it must not.
#include "protocol/gate.hpp"

#include <gtest/gtest.h>

#include <ctime>
#include <set>
#include <string>

#include "protocol/limits.hpp"
#include "tests/protocol/raw_packet.hpp"

namespace splash::protocol::test {
namespace {

struct Case {
  const char* name;
  Raw packet;
  Refusal expected;
};

Raw repeated(const Raw& part, std::size_t times) {
  Raw out;
  for (std::size_t i = 0; i < times; ++i) out = out + part;
  return out;
}

// `levels` bundles, each inside the one before.
Raw nested_bundles(std::size_t levels) {
  Raw out = bundle_head();
  for (std::size_t i = 1; i < levels && out.size() < 1400; ++i) out = bundle_head() + element(out);
  return out;
}

Raw in_bundle(const Raw& element_bytes) {
  return bundle_head() + element_bytes;
}

const Raw kFine = message("/impact", ",i", word(7));

std::vector<Case> datagram_killers() {
  return {
      {"zero bytes", {}, Refusal::empty},
      {"one byte", bytes("/"), Refusal::not_aligned},
      {"hello: oscpack's server terminates", bytes("hello"), Refusal::not_aligned},
      {"/abc unterminated: terminates too", bytes("/abc"), Refusal::bad_address},
      {"valid but 5000 bytes", message("/a", ",s", padded(std::string(4992, 'x'))),
       Refusal::too_long},
      {"65507 bytes", Raw(65507, std::byte{'/'}), Refusal::too_long},
      {"1476 zeros", Raw(1476), Refusal::too_long},
      {"four zeros", Raw(4), Refusal::bad_address},
      {"1472 zeros", Raw(1472), Refusal::bad_address},
      {"all ones", Raw(64, std::byte{0xff}), Refusal::bad_address},
      {"only commas", bytes(",,,,,,,,"), Refusal::bad_address},
      {"an address without slash", message("impact", ",i", word(1)), Refusal::bad_address},
      {"48-byte pattern bomb: liblo stalls for seconds",
       message("/*?*?*?*?*?*?*?*?*?*?*?*?*?*?*?*?*?*?q", ","), Refusal::bad_address},
      {"a pattern in braces", message("/{impact,bubble}", ","), Refusal::bad_address},
      {"a pattern in brackets", message("/impac[s-u]", ","), Refusal::bad_address},
      {"a blank in the address", message("/im pact", ","), Refusal::bad_address},
      {"a byte over 127 in the address", message("/\xc3\xa9", ","), Refusal::bad_address},
      {"address of 65 characters", message("/" + std::string(64, 'a'), ","), Refusal::bad_address},
  };
}

std::vector<Case> type_killers() {
  return {
      {"blob of 0x7ffffff0 bytes: oscpack believes it", message("/b", ",b", word(0x7ffffff0)),
       Refusal::bad_tags},
      {"blob without its size: both libraries read past the end", message("/b", ",b"),
       Refusal::bad_tags},
      {"blob of size zero", message("/b", ",b", word(0)), Refusal::bad_tags},
      {"arrays closed before opened: oscpack accepts", message("/a", ",]["), Refusal::bad_tags},
      {"an open array: scsynth crashes", message("/a", ",[i", word(1)), Refusal::bad_tags},
      {"a 64-bit integer", message("/a", ",h", word(0) + word(1)), Refusal::bad_tags},
      {"a double", message("/a", ",d", word(0) + word(1)), Refusal::bad_tags},
      {"a MIDI message", message("/a", ",m", word(0)), Refusal::bad_tags},
      {"true, false, nil, infinitum", message("/a", ",TFNI"), Refusal::bad_tags},
      {"no type string at all", padded("/abc"), Refusal::bad_tags},
      {"arguments but no comma", message("/abc", "i", word(1)), Refusal::bad_tags},
      {"type string not closed", padded("/abc") + bytes(",iii"), Refusal::bad_tags},
      {"a comma among the types", message("/abc", ",i,i", word(1) + word(1)), Refusal::bad_tags},
      {"25 arguments", message("/abc", "," + std::string(25, 'i'), Raw(100)),
       Refusal::too_many_arguments},
      {"1400 types and no argument", message("/abc", "," + std::string(1400, 'i')),
       Refusal::too_many_arguments},
  };
}

std::vector<Case> argument_killers() {
  return {
      {"an integer is missing", message("/a", ",ii", word(1)), Refusal::truncated},
      {"half a time tag", message("/a", ",t", word(1)), Refusal::truncated},
      {"text not closed", message("/a", ",s", bytes("abcd")), Refusal::truncated},
      {"text is missing", message("/a", ",s"), Refusal::truncated},
      {"text of 65 characters", message("/a", ",s", padded(std::string(65, 'x'))),
       Refusal::bad_string},
      {"a line feed in text", message("/a", ",s", padded("a\nb")), Refusal::bad_string},
      {"an escape in text", message("/a", ",s", padded("\x1b[2J")), Refusal::bad_string},
      {"UTF-8 in text", message("/a", ",s", padded("\xe2\x82\xac")), Refusal::bad_string},
      {"padding of text not zero", message("/a", ",s", bytes(std::string_view("a\0\0x", 4))),
       Refusal::bad_padding},
      {"padding of the types not zero",
       padded("/a") + bytes(std::string_view(",i\0x", 4)) + word(1), Refusal::bad_padding},
      {"padding of the address not zero", bytes(std::string_view("/a\0x", 4)) + padded(","),
       Refusal::bad_padding},
      {"quiet NaN", message("/a", ",f", word(0x7fc00000)), Refusal::not_finite},
      {"signalling NaN", message("/a", ",f", word(0xff800001)), Refusal::not_finite},
      {"infinity", message("/a", ",f", word(0x7f800000)), Refusal::not_finite},
      {"minus infinity", message("/a", ",if", word(1) + word(0xff800000)), Refusal::not_finite},
      {"four bytes left over", kFine + Raw(4), Refusal::left_over},
      {"two messages without a bundle", kFine + kFine, Refusal::left_over},
  };
}

std::vector<Case> bundle_killers() {
  return {
      {"20 bytes, size ff ff ff fc: oscpack hangs for ever", in_bundle(word(0xfffffffc)),
       Refusal::bad_element},
      {"size 7ffffffc", in_bundle(word(0x7ffffffc) + kFine), Refusal::bad_element},
      {"size 80000000", in_bundle(word(0x80000000) + kFine), Refusal::bad_element},
      {"element of size zero", in_bundle(word(0)), Refusal::bad_element},
      {"element of odd size", in_bundle(word(7) + bytes("/abc") + Raw(4)), Refusal::bad_element},
      {"element four bytes past the end",
       in_bundle(word(static_cast<std::uint32_t>(kFine.size() + 4)) + kFine), Refusal::bad_element},
      {"a second element of which only the size came", in_bundle(element(kFine) + word(16)),
       Refusal::bad_element},
      {"half a bundle's head", padded("#bundle") + word(0), Refusal::truncated},
      {"#bundle alone", padded("#bundle"), Refusal::truncated},
      {"#bundl", padded("#bundl") + word(0) + word(1), Refusal::bad_address},
      {"#bundles", bytes("#bundles") + word(0) + word(1), Refusal::bad_address},
      {"#", padded("#"), Refusal::bad_address},
      {"a bundle in a bundle", nested_bundles(2), Refusal::nested},
      {"as many levels as fit", nested_bundles(3200), Refusal::nested},
      {"3200 levels: liblo's stack overflows", Raw(64016, std::byte{'#'}), Refusal::too_long},
      {"65 messages", in_bundle(repeated(element(message("/a", ",")), 65)),
       Refusal::too_many_messages},
      {"NaN in the second message",
       in_bundle(element(kFine) + element(message("/a", ",f", word(0x7fc00000)))),
       Refusal::not_finite},
      {"four zeros as an element", in_bundle(element(Raw(4))), Refusal::bad_address},
      {"an element with bytes left over", in_bundle(element(kFine + Raw(4))), Refusal::left_over},
  };
}

std::vector<Case> legal_packets() {
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
      {"64 messages", in_bundle(repeated(element(message("/a", ",")), 64)), Refusal::none},
      {"a time tag in 1900", bundle_head(2) + element(kFine), Refusal::none},
      {"a time tag in 2100", bundle_head(0x76c0a580ULL << 32U) + element(kFine), Refusal::none},
      {"1472 bytes",
       bundle_head() + repeated(element(message("/a", sixteen, Raw(64))), 15) +
           element(message("/" + std::string(63, 'a'), ",")),
       Refusal::none},
  };
}

void expect_all(const std::vector<Case>& cases) {
  for (const auto& one : cases) {
    EXPECT_EQ(describe(gate(one.packet)), describe(one.expected)) << one.name;
  }
}

TEST(Gate, RefusesDatagramKillers) {
  expect_all(datagram_killers());
}
TEST(Gate, RefusesTypeKillers) {
  expect_all(type_killers());
}
TEST(Gate, RefusesArgumentKillers) {
  expect_all(argument_killers());
}
TEST(Gate, RefusesBundleKillers) {
  expect_all(bundle_killers());
}

TEST(Gate, LetsLegalPacketsPass) {
  expect_all(legal_packets());
  EXPECT_EQ(legal_packets().back().packet.size(), kMaxDatagram);
}

TEST(Gate, EveryReasonIsTriedAndHasWords) {
  std::set<Refusal> tried;
  for (const auto& list : {datagram_killers(), type_killers(), argument_killers(), bundle_killers(),
                           legal_packets()}) {
    for (const auto& one : list) tried.insert(one.expected);
  }
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
TEST(Gate, NoPacketStallsIt) {
  for (const auto& list : {datagram_killers(), type_killers(), argument_killers(), bundle_killers(),
                           legal_packets()}) {
    for (const auto& one : list) {
      double least = 1.0;
      for (int i = 0; i < 5; ++i) {
        const double start = processor_time();
        (void)gate(one.packet);
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
