// SPDX-License-Identifier: MIT
#include "tests/protocol/killers.hpp"

#include <utility>

#include "protocol/message.hpp"
#include "tests/protocol/raw_packet.hpp"

namespace splash::protocol::test {
namespace {

constexpr std::uint64_t kNow = 0x83AA7E8000000000ULL;  // 1970

Raw filled(std::size_t size, char c) {
  return bytes(std::string(size, c));
}

Raw with_float(std::uint32_t bits) {
  return padded("/x") + padded(",f") + word(bits);
}

Raw harmless() {
  return message("/x", ",");
}

/// A bundle whose only element says it has `size` bytes.
Raw sized(std::uint32_t size, const Raw& rest = harmless()) {
  return bundle_head(kNow) + word(size) + rest;
}

Raw nested(std::uint32_t levels) {
  Raw packet;
  for (std::uint32_t inside = levels; inside-- > 0;) {
    packet = std::move(packet) + bundle_head(kNow) + word(20 * inside + 8);
  }
  return std::move(packet) + harmless();
}

std::string repeated(const std::string& piece, std::size_t times) {
  std::string text;
  for (std::size_t i = 0; i < times; ++i) text += piece;
  return text;
}

Raw many_messages(std::size_t count) {
  Raw packet = bundle_head(kNow);
  for (std::size_t i = 0; i < count; ++i) packet = packet + element(harmless());
  return packet;
}

/// A bubble of this frame, at a moment nobody will live to hear.
Raw bubble_at(std::uint64_t tag, std::int32_t sequence) {
  return encode(TimeTag{tag}, {to_message(Frame{4711, sequence, 0, 0.0F}),
                               to_message(Bubble{1, -1, 0.004F, 0.05F, {}, 0.0F})});
}

std::vector<Killer> make_killers() {
  return {
      {"nothing at all", {}, Refusal::empty},
      {"a word: ends oscpack's listener", bytes("hello"), Refusal::not_aligned},
      {"one byte", bytes("/"), Refusal::not_aligned},
      {"5000 bytes: cut by oscpack's buffer", filled(5000, 'a'), Refusal::too_long},
      {"the largest datagram", filled(65507, '\0'), Refusal::too_long},
      {"one byte over a frame", filled(1473, '/'), Refusal::too_long},
      {"an address that is not closed", bytes("/abc"), Refusal::bad_address},
      {"an address of a whole frame", bytes("/" + std::string(1471, 'a')), Refusal::bad_address},
      {"four zeros", filled(4, '\0'), Refusal::bad_address},
      {"no slash", padded("x") + padded(","), Refusal::bad_address},
      {"a pattern bomb of 32 bytes", padded("/" + repeated("*?", 11) + "q") + padded(","),
       Refusal::bad_address},
      {"a pattern bomb of 48 bytes", padded("/" + repeated("*?", 19) + "q") + padded(","),
       Refusal::bad_address},
      {"a pattern of braces", padded("/{bubble,cavity}") + padded(","), Refusal::bad_address},
      {"a character set", padded("/[a-z]*") + padded(","), Refusal::bad_address},
      {"a newline in an address", padded("/a\nb") + padded(","), Refusal::bad_address},
      {"an escape sequence", padded("/\x1b[2J") + padded(","), Refusal::bad_address},
      {"#bundl", padded("#bundl"), Refusal::bad_address},
      {"no type string", padded("/x"), Refusal::bad_tags},
      {"types without a comma", padded("/x") + padded("i") + word(1), Refusal::bad_tags},
      {"a blob of 2 GB in 12 bytes", padded("/b") + padded(",b") + word(0x7ffffff0),
       Refusal::bad_tags},
      {"a blob without its size", padded("/b") + padded(",b"), Refusal::bad_tags},
      {"a blob of -1 bytes", padded("/b") + padded(",b") + word(0xffffffff), Refusal::bad_tags},
      {"an array that closes first", padded("/x") + padded(",]["), Refusal::bad_tags},
      {"arrays in arrays", padded("/x") + padded("," + std::string(60, '[')), Refusal::bad_tags},
      {"types of no kind", padded("/x") + padded(",\x01\x02"), Refusal::bad_tags},
      {"a thousand arguments", padded("/x") + padded("," + std::string(1000, 'i')),
       Refusal::too_many_arguments},
      {"arguments cut off", padded("/x") + padded(",ff") + word(0x3f800000), Refusal::truncated},
      {"a text that is not closed", padded("/x") + padded(",s") + bytes("abcd"),
       Refusal::truncated},
      {"a bundle's head alone", padded("#bundle"), Refusal::truncated},
      {"padding that is not zero", bytes(std::string("/x\0y,\0\0\0", 8)), Refusal::bad_padding},
      {"not a number", with_float(0x7fc00000), Refusal::not_finite},
      {"a signalling one", with_float(0x7f800001), Refusal::not_finite},
      {"infinity", with_float(0x7f800000), Refusal::not_finite},
      {"minus infinity", with_float(0xff800000), Refusal::not_finite},
      {"a text that rings the bell", padded("/x") + padded(",s") + padded("\a"),
       Refusal::bad_string},
      {"a text that is too long", padded("/x") + padded(",s") + padded(std::string(65, 'a')),
       Refusal::bad_string},
      {"the 20 bytes that hang oscpack", bundle_head(kNow) + word(0xfffffffc),
       Refusal::bad_element},
      {"an element of size zero", bundle_head(kNow) + word(0), Refusal::bad_element},
      {"an element of odd size", sized(3, padded("/x")), Refusal::bad_element},
      {"an element past the end", sized(256), Refusal::bad_element},
      {"an element of 2 GB", sized(0x7ffffffc), Refusal::bad_element},
      {"3200 bundles in each other", nested(3200), Refusal::too_long},
      {"70 bundles in each other", nested(70), Refusal::nested},
      {"two bundles in each other", nested(2), Refusal::nested},
      {"as many messages as fit", many_messages(65), Refusal::too_many_messages},
      {"bytes left over", harmless() + word(0), Refusal::left_over},
      {"an empty bundle", bundle_head(kNow), Refusal::none},
      {"a number too small to be normal", with_float(1), Refusal::none},
      {"a bubble in 1900", bubble_at(2, 0), Refusal::none},
      {"a bubble in 2100", bubble_at(0x78C3D98000000000ULL, 1), Refusal::none},
      {"a bubble at the end of time", bubble_at(~0ULL, 2), Refusal::none},
  };
}

}  // namespace

const std::vector<Killer>& killers() {
  static const std::vector<Killer> kKillers = make_killers();
  return kKillers;
}

}  // namespace splash::protocol::test
