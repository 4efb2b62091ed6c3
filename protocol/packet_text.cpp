// SPDX-License-Identifier: MIT
#include "protocol/packet_text.hpp"

#include <cstdio>
#include <variant>

namespace splash::protocol {
namespace {

std::string text_of(std::int32_t value) {
  return std::to_string(value);
}

std::string text_of(const std::string& value) {
  return '"' + value + '"';
}

std::string text_of(float value) {
  char text[32];
  // Nine digits name each float and no other (IEEE 754-2008, 5.12.2).
  std::snprintf(text, sizeof text, "%.9g", static_cast<double>(value));
  return text;
}

std::string text_of(TimeTag tag) {
  char text[32];
  std::snprintf(text, sizeof text, "%08x.%08x", static_cast<unsigned>(tag.value >> 32U),
                static_cast<unsigned>(tag.value & 0xffffffffU));
  return text;
}

}  // namespace

std::string to_text(const Message& message, const std::optional<TimeTag>& time) {
  std::string text = time ? text_of(*time) + ' ' : std::string();
  text += message.address + ' ' + type_tags(message);
  for (const auto& argument : message.arguments) {
    text += ' ' + std::visit([](const auto& value) { return text_of(value); }, argument);
  }
  return text;
}

std::string to_hexadecimal(Bytes bytes) {
  static constexpr char kDigits[] = "0123456789abcdef";
  std::string text;
  for (const std::byte byte : bytes) {
    if (!text.empty()) text += ' ';
    text += kDigits[std::to_integer<unsigned>(byte >> 4)];
    text += kDigits[std::to_integer<unsigned>(byte & std::byte{0x0F})];
  }
  return text;
}

}  // namespace splash::protocol
