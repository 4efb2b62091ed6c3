// SPDX-License-Identifier: MIT
#include "tests/protocol/killers.hpp"

#include <utility>

#include "protocol/message.hpp"
#include "tests/protocol/raw_packet.hpp"

namespace splash::protocol::test {
namespace {

constexpr std::uint64_t kNow = 0x83AA7E8000000000ULL;  // 1970

Raw with_float(std::uint32_t bits) {
  return message("/x", ",f", word(bits));
}

Raw harmless() {
  return message("/x", ",");
}

Raw in_bundle(const Raw& elements) {
  return bundle_head(kNow) + elements;
}

Raw nested(std::uint32_t levels) {
  Raw packet;
  for (std::uint32_t inside = levels; inside-- > 0;) {
    packet = std::move(packet) + bundle_head(kNow) + word(20 * inside + 8);
  }
  return std::move(packet) + harmless();
}

/// A bubble of this frame, at a moment nobody will live to hear.
Raw bubble_at(std::uint64_t tag, std::int32_t sequence) {
  return encode(TimeTag{tag}, {to_message(Frame{4711, sequence, 0, 0.0F}),
                               to_message(Bubble{1, -1, 0.004F, 0.05F, {}, 0.0F})});
}

std::vector<Killer> datagrams() {
  return {
      {"nothing at all", {}, Refusal::empty},
      {"a word: ends oscpack's listener", bytes("hello"), Refusal::not_aligned},
      {"one byte", bytes("/"), Refusal::not_aligned},
      {"legal but for its 5000 bytes: cut by oscpack's buffer",
       message("/a", ",s", padded(std::string(4992, 'x'))), Refusal::too_long},
      {"the largest datagram", Raw(65507), Refusal::too_long},
      {"one byte over a frame", Raw(1473, std::byte{'/'}), Refusal::too_long},
      {"one word over a frame", Raw(1476), Refusal::too_long},
      {"an address that is not closed: ends oscpack's listener", bytes("/abc"),
       Refusal::bad_address},
      {"an address of a whole frame", bytes("/" + std::string(1471, 'a')), Refusal::bad_address},
      {"an address of 65 characters", message("/" + std::string(64, 'a'), ","),
       Refusal::bad_address},
      {"four zeros", Raw(4), Refusal::bad_address},
      {"all ones", Raw(64, std::byte{0xff}), Refusal::bad_address},
      {"only commas", bytes(",,,,,,,,"), Refusal::bad_address},
      {"no slash", message("impact", ",i", word(1)), Refusal::bad_address},
      {"a pattern bomb of 32 bytes", message("/*?*?*?*?*?*?*?*?*?*?*?q", ","),
       Refusal::bad_address},
      {"a pattern bomb of 48 bytes: liblo stalls for seconds",
       message("/*?*?*?*?*?*?*?*?*?*?*?*?*?*?*?*?*?*?*?q", ","), Refusal::bad_address},
      {"a pattern of braces", message("/{bubble,cavity}", ","), Refusal::bad_address},
      {"a character set", message("/[a-z]*", ","), Refusal::bad_address},
      {"a newline in an address", message("/a\nb", ","), Refusal::bad_address},
      {"an escape sequence", message("/\x1b[2J", ","), Refusal::bad_address},
      {"a blank in an address", message("/im pact", ","), Refusal::bad_address},
      {"a byte over 127 in an address", message("/\xc3\xa9", ","), Refusal::bad_address},
      {"#", padded("#"), Refusal::bad_address},
      {"#bundl", padded("#bundl"), Refusal::bad_address},
      {"#bundles", bytes("#bundles") + word(0) + word(1), Refusal::bad_address},
  };
}

std::vector<Killer> types() {
  return {
      {"no type string", padded("/x"), Refusal::bad_tags},
      {"types without a comma", message("/x", "i", word(1)), Refusal::bad_tags},
      {"types that are not closed", padded("/abc") + bytes(",iii"), Refusal::bad_tags},
      {"a comma among the types", message("/x", ",i,i", word(1) + word(1)), Refusal::bad_tags},
      {"a blob of 2 GB in 12 bytes: oscpack believes it", message("/b", ",b", word(0x7ffffff0)),
       Refusal::bad_tags},
      {"a blob without its size: both libraries read past the end", message("/b", ",b"),
       Refusal::bad_tags},
      {"a blob of -1 bytes", message("/b", ",b", word(0xffffffff)), Refusal::bad_tags},
      {"a blob of no bytes", message("/b", ",b", word(0)), Refusal::bad_tags},
      {"an array that closes first: oscpack accepts", message("/x", ",]["), Refusal::bad_tags},
      {"an open array: scsynth crashes", message("/x", ",[i", word(1)), Refusal::bad_tags},
      {"arrays in arrays", message("/x", "," + std::string(60, '[')), Refusal::bad_tags},
      {"a 64-bit integer", message("/x", ",h", word(0) + word(1)), Refusal::bad_tags},
      {"a double", message("/x", ",d", word(0) + word(1)), Refusal::bad_tags},
      {"a MIDI message", message("/x", ",m", word(0)), Refusal::bad_tags},
      {"true, false, nil, infinitum", message("/x", ",TFNI"), Refusal::bad_tags},
      {"types of no kind", message("/x", ",\x01\x02"), Refusal::bad_tags},
      {"25 arguments", message("/x", "," + std::string(25, 'i'), Raw(100)),
       Refusal::too_many_arguments},
      {"a thousand arguments", message("/x", "," + std::string(1000, 'i')),
       Refusal::too_many_arguments},
  };
}

std::vector<Killer> arguments() {
  return {
      {"arguments cut off", message("/x", ",ff", word(0x3f800000)), Refusal::truncated},
      {"half a time tag", message("/x", ",t", word(1)), Refusal::truncated},
      {"a text that is not closed", message("/x", ",s", bytes("abcd")), Refusal::truncated},
      {"a text that is missing", message("/x", ",s"), Refusal::truncated},
      {"a text that is too long", message("/x", ",s", padded(std::string(65, 'a'))),
       Refusal::bad_string},
      {"a text that rings the bell", message("/x", ",s", padded("\a")), Refusal::bad_string},
      {"a line feed in a text", message("/x", ",s", padded("a\nb")), Refusal::bad_string},
      {"an escape in a text", message("/x", ",s", padded("\x1b[2J")), Refusal::bad_string},
      {"UTF-8 in a text", message("/x", ",s", padded("\xe2\x82\xac")), Refusal::bad_string},
      {"padding of a text not zero", message("/x", ",s", bytes(std::string_view("a\0\0x", 4))),
       Refusal::bad_padding},
      {"padding of the types not zero",
       padded("/x") + bytes(std::string_view(",i\0x", 4)) + word(1), Refusal::bad_padding},
      {"padding of the address not zero", bytes(std::string_view("/x\0y", 4)) + padded(","),
       Refusal::bad_padding},
      {"not a number", with_float(0x7fc00000), Refusal::not_finite},
      {"a signalling one", with_float(0x7f800001), Refusal::not_finite},
      {"infinity", with_float(0x7f800000), Refusal::not_finite},
      {"minus infinity, second", message("/x", ",if", word(1) + word(0xff800000)),
       Refusal::not_finite},
      {"bytes left over", harmless() + word(0), Refusal::left_over},
      {"two messages without a bundle", harmless() + harmless(), Refusal::left_over},
  };
}

std::vector<Killer> bundles() {
  return {
      {"a bundle's head alone", padded("#bundle"), Refusal::truncated},
      {"half a bundle's head", padded("#bundle") + word(0), Refusal::truncated},
      {"the 20 bytes that hang oscpack", in_bundle(word(0xfffffffc)), Refusal::bad_element},
      {"an element of size zero", in_bundle(word(0)), Refusal::bad_element},
      {"an element of odd size", in_bundle(word(3) + padded("/x")), Refusal::bad_element},
      {"an element one word past the end", in_bundle(word(12) + harmless()), Refusal::bad_element},
      {"an element of 2 GB", in_bundle(word(0x7ffffffc) + harmless()), Refusal::bad_element},
      {"an element of -2 GB", in_bundle(word(0x80000000) + harmless()), Refusal::bad_element},
      {"a second element of which only the size came", in_bundle(element(harmless()) + word(16)),
       Refusal::bad_element},
      {"3200 bundles in each other: liblo's stack overflows", nested(3200), Refusal::too_long},
      {"70 bundles in each other", nested(70), Refusal::nested},
      {"two bundles in each other", nested(2), Refusal::nested},
      {"one message more than fits", in_bundle(repeated(element(harmless()), 65)),
       Refusal::too_many_messages},
      {"not a number in the second message",
       in_bundle(element(harmless()) + element(with_float(0x7fc00000))), Refusal::not_finite},
      {"four zeros as an element", in_bundle(element(Raw(4))), Refusal::bad_address},
      {"an element with bytes left over", in_bundle(element(harmless() + word(0))),
       Refusal::left_over},
  };
}

std::vector<Killer> legal() {
  return {
      {"an empty bundle", bundle_head(kNow), Refusal::none},
      {"a number too small to be normal", with_float(1), Refusal::none},
      {"a bubble in 1900", bubble_at(2, 0), Refusal::none},
      {"a bubble in 2100", bubble_at(0x78C3D98000000000ULL, 1), Refusal::none},
      {"a bubble at the end of time", bubble_at(~0ULL, 2), Refusal::none},
  };
}

std::vector<Killer> make_killers() {
  std::vector<Killer> all;
  for (const auto& list : {datagrams(), types(), arguments(), bundles(), legal()}) {
    all.insert(all.end(), list.begin(), list.end());
  }
  return all;
}

}  // namespace

const std::vector<Killer>& killers() {
  static const std::vector<Killer> kKillers = make_killers();
  return kKillers;
}

}  // namespace splash::protocol::test
