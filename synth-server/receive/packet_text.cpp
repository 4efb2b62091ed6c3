// SPDX-License-Identifier: MIT
#include "synth-server/receive/packet_text.hpp"

#include <cstdio>

namespace splash::synth {
namespace {

std::string text_of(std::int32_t value) {
  return std::to_string(value);
}
std::string text_of(const std::string& value) {
  return '"' + value + '"';
}

std::string text_of(float value) {
  char text[32];
  std::snprintf(text, sizeof text, "%.9g", static_cast<double>(value));
  return text;
}

std::string text_of(protocol::TimeTag tag) {
  char text[32];
  std::snprintf(text, sizeof text, "%08x.%08x", static_cast<unsigned>(tag.value >> 32U),
                static_cast<unsigned>(tag.value & 0xffffffffU));
  return text;
}

}  // namespace

std::string to_text(const protocol::Packet& packet) {
  std::string text;
  for (const auto& message : packet.messages) {
    if (!text.empty()) text += '\n';
    if (packet.time) text += text_of(*packet.time) + ' ';
    text += message.address;
    for (const auto& argument : message.arguments) {
      text += ' ' + std::visit([](const auto& value) { return text_of(value); }, argument);
    }
  }
  return text;
}

std::string to_hexadecimal(protocol::Bytes bytes) {
  std::string text;
  for (const std::byte byte : bytes) {
    char digits[4];
    std::snprintf(digits, sizeof digits, "%02x", std::to_integer<unsigned>(byte));
    text += (text.empty() ? "" : " ") + std::string(digits);
  }
  return text;
}

}  // namespace splash::synth
