// SPDX-License-Identifier: MIT
// One visitor for the argument types, one loop for the bytes.
#include "sim-server/listen/dump.hpp"

#include <cstdio>
#include <variant>

namespace splash::sim {
namespace {

struct Print {
  std::string operator()(std::int32_t value) const { return std::to_string(value); }
  std::string operator()(float value) const {
    char text[32];
    // Nine digits name each float and no other (IEEE 754-2008, 5.12.2).
    std::snprintf(text, sizeof text, "%.9g", static_cast<double>(value));
    return text;
  }
  std::string operator()(const std::string& value) const { return '"' + value + '"'; }
  std::string operator()(protocol::TimeTag value) const {
    char text[32];
    std::snprintf(text, sizeof text, "%016llx", static_cast<unsigned long long>(value.value));
    return text;
  }
};

}  // namespace

std::string to_text(const protocol::Message& message) {
  std::string text = message.address + ' ' + protocol::type_tags(message);
  for (const auto& argument : message.arguments) text += ' ' + std::visit(Print{}, argument);
  return text;
}

std::string to_hexadecimal(protocol::Bytes bytes) {
  static constexpr char kDigits[] = "0123456789abcdef";
  std::string text;
  for (const auto byte : bytes) {
    if (!text.empty()) text += ' ';
    text += kDigits[std::to_integer<unsigned>(byte >> 4)];
    text += kDigits[std::to_integer<unsigned>(byte & std::byte{0x0F})];
  }
  return text;
}

}  // namespace splash::sim
