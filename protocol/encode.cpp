// SPDX-License-Identifier: MIT
// Messages to OSC 1.0 bytes: big-endian, everything padded with zeros to four bytes. What it
// returns always passes the gate.
#include <bit>
#include <stdexcept>

#include "protocol/limits.hpp"
#include "protocol/message.hpp"

namespace splash::protocol {
namespace {

using Buffer = std::vector<std::byte>;

void append_big_endian(Buffer& out, std::uint64_t value, int bytes) {
  for (int shift = 8 * (bytes - 1); shift >= 0; shift -= 8) {
    out.push_back(static_cast<std::byte>(value >> static_cast<unsigned>(shift) & 0xffU));
  }
}

void append_text(Buffer& out, const std::string& text) {
  if (text.find('\0') != std::string::npos) {
    const std::string shown = text.substr(0, text.find('\0'));
    throw std::length_error("OSC text '" + shown + "' holds a zero byte");
  }
  for (const char c : text) out.push_back(static_cast<std::byte>(c));
  out.resize(out.size() / 4 * 4 + 4);
}

struct AppendArgument {
  Buffer& out;
  void operator()(std::int32_t value) const {
    append_big_endian(out, static_cast<std::uint32_t>(value), 4);
  }
  void operator()(float value) const {
    append_big_endian(out, std::bit_cast<std::uint32_t>(value), 4);
  }
  void operator()(const std::string& value) const { append_text(out, value); }
  void operator()(TimeTag value) const { append_big_endian(out, value.value, 8); }
};

void append_message(Buffer& out, const Message& message) {
  append_text(out, message.address);
  append_text(out, type_tags(message));
  for (const auto& argument : message.arguments) std::visit(AppendArgument{out}, argument);
}

Buffer gated(Buffer packet, const std::string& what) {
  const auto refusal = gate(packet);
  if (refusal == Refusal::none) return packet;
  throw std::length_error("cannot send " + what + " (" + std::to_string(packet.size()) +
                          " bytes): " + std::string(describe(refusal)));
}

std::size_t padded_size(std::size_t characters) {
  return characters / 4 * 4 + 4;
}

}  // namespace

std::string type_tags(const Message& message) {
  static constexpr char kTypes[] = {'i', 'f', 's', 't'};  // in the order of Argument's types
  std::string tags = ",";
  for (const auto& argument : message.arguments) tags += kTypes[argument.index()];
  return tags;
}

std::size_t encoded_size(const Message& message) noexcept {
  std::size_t size =
      padded_size(message.address.size()) + padded_size(message.arguments.size() + 1);
  for (const auto& argument : message.arguments) {
    if (const auto* text = std::get_if<std::string>(&argument)) {
      size += padded_size(text->size());
    } else {
      size += std::holds_alternative<TimeTag>(argument) ? 8 : 4;
    }
  }
  return size;
}

std::vector<std::byte> encode(const Message& message) {
  Buffer out;
  out.reserve(encoded_size(message));
  append_message(out, message);
  return gated(std::move(out), "message '" + message.address + "'");
}

std::vector<std::byte> encode(TimeTag time, const std::vector<Message>& messages) {
  Buffer out;
  out.reserve(kMaxDatagram);
  append_text(out, "#bundle");
  append_big_endian(out, time.value, 8);
  for (const auto& message : messages) {
    append_big_endian(out, encoded_size(message), 4);
    append_message(out, message);
  }
  return gated(std::move(out), "bundle of " + std::to_string(messages.size()) + " messages");
}

}  // namespace splash::protocol
