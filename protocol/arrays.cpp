// SPDX-License-Identifier: MIT
#include "protocol/arrays.hpp"

#include <algorithm>

#include "protocol/limits.hpp"

namespace splash::protocol {
namespace {

constexpr std::size_t kBundleHead = 16;
constexpr std::size_t kWord = 4;

/// Bytes that a text and its padding take; 0: it is not closed.
std::size_t text_size(Bytes rest) {
  const auto end = std::find(rest.begin(), rest.end(), std::byte{0});
  const auto length = static_cast<std::size_t>(end - rest.begin());
  const std::size_t padded = length / kWord * kWord + kWord;
  return length == rest.size() || padded > rest.size() ? 0 : padded;
}

/// Returns whether the brackets of a type string match.
bool is_balanced(Bytes tags) {
  int depth = 0;
  for (const std::byte tag : tags) {
    depth += tag == std::byte{'['} ? 1 : 0;
    depth -= tag == std::byte{']'} ? 1 : 0;
    if (depth < 0) return false;
  }
  return depth == 0;
}

bool is_bracket(std::byte byte) {
  return byte == std::byte{'['} || byte == std::byte{']'};
}

/// Adds the message without brackets; false: it is none.
bool add_message(Bytes message, std::vector<std::byte>& out) {
  const std::size_t address = text_size(message);
  if (address == 0) return false;
  const Bytes rest = message.subspan(address);
  const std::size_t tags = text_size(rest);
  if (tags == 0 || rest.front() != std::byte{','} || !is_balanced(rest.first(tags))) return false;
  out.insert(out.end(), message.begin(), message.begin() + static_cast<std::ptrdiff_t>(address));
  const std::size_t begin = out.size();
  for (const std::byte tag : rest.first(tags)) {
    if (tag == std::byte{0}) break;
    if (!is_bracket(tag)) out.push_back(tag);
  }
  do {
    out.push_back(std::byte{0});
  } while ((out.size() - begin) % kWord != 0);
  const Bytes arguments = rest.subspan(tags);
  out.insert(out.end(), arguments.begin(), arguments.end());
  return true;
}

void put_size(std::vector<std::byte>& out, std::size_t at, std::size_t size) {
  for (std::size_t i = 0; i < kWord; ++i) {
    out[at + i] = static_cast<std::byte>(size >> (8 * (kWord - 1 - i)));
  }
}

}  // namespace

std::optional<std::vector<std::byte>> without_arrays(Bytes packet) {
  const bool possible = packet.size() >= kWord && packet.size() <= kMaxDatagram &&
                        packet.size() % kWord == 0 &&
                        std::any_of(packet.begin(), packet.end(), is_bracket);
  if (!possible) return std::nullopt;
  std::vector<std::byte> out;
  if (packet.front() != std::byte{'#'}) {
    return add_message(packet, out) ? std::optional(out) : std::nullopt;
  }
  if (packet.size() < kBundleHead) return std::nullopt;
  out.assign(packet.begin(), packet.begin() + kBundleHead);
  for (Bytes rest = packet.subspan(kBundleHead); !rest.empty();) {
    std::size_t size = 0;
    for (std::size_t i = 0; i < kWord; ++i)
      size = size << 8U | std::to_integer<std::size_t>(rest[i]);
    rest = rest.subspan(kWord);
    if (size == 0 || size % kWord != 0 || size > rest.size()) return std::nullopt;
    const std::size_t at = out.size();
    out.resize(at + kWord);
    if (!add_message(rest.first(size), out)) return std::nullopt;
    put_size(out, at, out.size() - at - kWord);
    rest = rest.subspan(size);
  }
  return out;
}

DecodeResult decode_with_arrays(Bytes packet) {
  DecodeResult decoded = decode(packet);
  if (decoded.refusal != Refusal::bad_tags) return decoded;
  const auto plain = without_arrays(packet);
  return plain ? decode(*plain) : decoded;
}

}  // namespace splash::protocol
