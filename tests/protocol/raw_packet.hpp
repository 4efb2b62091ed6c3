// SPDX-License-Identifier: MIT
// OSC bytes written by hand, right or wrong on purpose.
#pragma once

#include <cstddef>
#include <cstdint>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

namespace splash::protocol::test {

using Raw = std::vector<std::byte>;

inline Raw bytes(std::string_view text) {
  Raw out;
  for (const char c : text) out.push_back(static_cast<std::byte>(c));
  return out;
}

inline Raw operator+(Raw left, const Raw& right) {
  // g++ 12 believes that insert() of a whole vector passes its end.
  for (const std::byte byte : right) left.push_back(byte);
  return left;
}

inline Raw repeated(const Raw& part, std::size_t times) {
  Raw out;
  for (std::size_t i = 0; i < times; ++i) out = std::move(out) + part;
  return out;
}

inline Raw word(std::uint32_t value) {
  Raw out;
  for (int shift = 24; shift >= 0; shift -= 8) {
    out.push_back(static_cast<std::byte>(value >> static_cast<unsigned>(shift) & 0xffU));
  }
  return out;
}

/// Text with its closing zero and padding.
inline Raw padded(std::string_view text) {
  Raw out = bytes(text);
  out.resize(text.size() / 4 * 4 + 4);
  return out;
}

inline Raw message(std::string_view address, std::string_view types, const Raw& arguments = {}) {
  return padded(address) + padded(types) + arguments;
}

inline Raw bundle_head(std::uint64_t time = 1) {
  return padded("#bundle") + word(static_cast<std::uint32_t>(time >> 32U)) +
         word(static_cast<std::uint32_t>(time));
}

/// An element behind its true size.
inline Raw element(const Raw& packet) {
  return word(static_cast<std::uint32_t>(packet.size())) + packet;
}

}  // namespace splash::protocol::test
