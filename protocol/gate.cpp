// SPDX-License-Identifier: MIT
// The gate's rules, read front to back with one cursor that cannot pass the packet's end.
#include "protocol/gate.hpp"

#include <algorithm>
#include <array>
#include <cstdint>
#include <cstring>

#include "protocol/limits.hpp"

namespace splash::protocol {
namespace {

constexpr std::size_t kBundleHead = 16;  // "#bundle\0" and the time tag

constexpr std::array<std::string_view, static_cast<std::size_t>(Refusal::count_)> kReasons = {
    "accepted",
    "empty datagram",
    "longer than 1472 bytes",
    "length is no multiple of four",
    "address must be '/' and letters, digits, / _ . -, closed, at most 64 characters",
    "types must be given and only i f s t",
    "more than 24 arguments",
    "an argument or element passes the end",
    "padding is not zero",
    "a number is NaN or infinite",
    "text must be printable ASCII, at most 64 characters",
    "bundle element's size is zero, no multiple of four or passes the end",
    "bundle inside a bundle",
    "more than 64 messages in a bundle",
    "bytes left over behind the last argument",
};

constexpr bool is_address_character(unsigned char c) {
  return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || (c >= '0' && c <= '9') || c == '/' ||
         c == '_' || c == '.' || c == '-';
}
constexpr bool is_printable(unsigned char c) {
  return c >= 0x20 && c <= 0x7e;
}

unsigned char byte_at(Bytes bytes, std::size_t index) {
  return std::to_integer<unsigned char>(bytes[index]);
}

std::uint32_t read_u32(Bytes bytes) {
  std::uint32_t value = 0;
  for (std::size_t i = 0; i < 4; ++i) value = value << 8U | byte_at(bytes, i);
  return value;
}

// Takes the text at the head of `rest`, its closing zero and its padding. `rest` is always a
// multiple of four long, so a zero within it has its whole padding within it too.
template <class Allowed>
Refusal take_text(Bytes& rest, Refusal bad, Refusal unclosed, Allowed allowed) {
  std::size_t length = 0;
  while (length < rest.size() && byte_at(rest, length) != 0) {
    if (length == kMaxString || !allowed(byte_at(rest, length))) return bad;
    ++length;
  }
  if (length == rest.size()) return unclosed;
  const std::size_t padded = length / 4 * 4 + 4;
  for (std::size_t i = length; i < padded; ++i) {
    if (byte_at(rest, i) != 0) return Refusal::bad_padding;
  }
  rest = rest.subspan(padded);
  return Refusal::none;
}

Refusal take_argument(Bytes& rest, unsigned char type) {
  if (type == 's') return take_text(rest, Refusal::bad_string, Refusal::truncated, is_printable);
  const std::size_t size = type == 't' ? 8 : 4;
  if (rest.size() < size) return Refusal::truncated;
  // The exponent's bits, not isfinite(): no compiler option can fold this test away.
  constexpr std::uint32_t kExponent = 0x7f800000U;
  if (type == 'f' && (read_u32(rest) & kExponent) == kExponent) return Refusal::not_finite;
  rest = rest.subspan(size);
  return Refusal::none;
}

constexpr bool is_type(unsigned char c) {
  return c == 'i' || c == 'f' || c == 's' || c == 't';
}

Refusal check_message(Bytes rest) {
  if (byte_at(rest, 0) != '/') return Refusal::bad_address;
  auto refusal = take_text(rest, Refusal::bad_address, Refusal::bad_address, is_address_character);
  if (refusal != Refusal::none) return refusal;
  if (rest.empty() || byte_at(rest, 0) != ',') return Refusal::bad_tags;

  Bytes types = rest.subspan(1);
  std::size_t count = 0;
  while (count < types.size() && is_type(byte_at(types, count))) {
    if (++count > kMaxArguments) return Refusal::too_many_arguments;
  }
  const auto is_tag = [](unsigned char c) { return c == ',' || is_type(c); };
  refusal = take_text(rest, Refusal::bad_tags, Refusal::bad_tags, is_tag);
  if (refusal != Refusal::none) return refusal;
  if (byte_at(types, count) != 0) return Refusal::bad_tags;  // a second comma

  for (std::size_t i = 0; i < count; ++i) {
    refusal = take_argument(rest, byte_at(types, i));
    if (refusal != Refusal::none) return refusal;
  }
  return rest.empty() ? Refusal::none : Refusal::left_over;
}

Refusal check_bundle(Bytes packet) {
  static constexpr std::array<char, 8> kTag = {'#', 'b', 'u', 'n', 'd', 'l', 'e', '\0'};
  if (packet.size() < kTag.size() || std::memcmp(packet.data(), kTag.data(), kTag.size()) != 0) {
    return Refusal::bad_address;
  }
  if (packet.size() < kBundleHead) return Refusal::truncated;
  Bytes rest = packet.subspan(kBundleHead);
  for (std::size_t messages = 0; !rest.empty(); ++messages) {
    if (messages == kMaxMessages) return Refusal::too_many_messages;
    const std::size_t size = read_u32(rest);  // a multiple of four is left: at least four bytes
    rest = rest.subspan(4);
    if (size == 0 || size % 4 != 0 || size > rest.size()) return Refusal::bad_element;
    const Bytes element = rest.first(size);
    if (byte_at(element, 0) == '#') return Refusal::nested;
    const auto refusal = check_message(element);
    if (refusal != Refusal::none) return refusal;
    rest = rest.subspan(size);
  }
  return Refusal::none;
}

}  // namespace

Refusal gate(Bytes packet) noexcept {
  if (packet.empty()) return Refusal::empty;
  if (packet.size() > kMaxDatagram) return Refusal::too_long;
  if (packet.size() % 4 != 0) return Refusal::not_aligned;
  return byte_at(packet, 0) == '#' ? check_bundle(packet) : check_message(packet);
}

std::string_view describe(Refusal refusal) noexcept {
  const auto index = static_cast<std::size_t>(refusal);
  return index < kReasons.size() ? kReasons[index] : "unknown reason";
}

}  // namespace splash::protocol
