// SPDX-License-Identifier: MIT
// OSC bytes to messages. Only reads what the gate has accepted, so nothing is checked twice.
#include <bit>

#include "protocol/message.hpp"

namespace splash::protocol {
namespace {

class Cursor {
 public:
  explicit Cursor(Bytes bytes) : rest_(bytes) {}
  [[nodiscard]] bool at_end() const { return rest_.empty(); }

  std::uint64_t take_big_endian(std::size_t size) {
    std::uint64_t value = 0;
    for (const auto byte : rest_.first(size)) {
      value = value << 8U | std::to_integer<std::uint64_t>(byte);
    }
    rest_ = rest_.subspan(size);
    return value;
  }

  std::uint32_t take_u32() { return static_cast<std::uint32_t>(take_big_endian(4)); }

  std::string take_text() {
    std::string text;
    while (rest_[text.size()] != std::byte{0}) {
      text += static_cast<char>(rest_[text.size()]);
    }
    rest_ = rest_.subspan(text.size() / 4 * 4 + 4);
    return text;
  }

  Bytes take(std::size_t size) {
    const Bytes taken = rest_.first(size);
    rest_ = rest_.subspan(size);
    return taken;
  }

 private:
  Bytes rest_;
};

Argument take_argument(Cursor& cursor, char type) {
  switch (type) {
    case 'i':
      return static_cast<std::int32_t>(cursor.take_u32());
    case 'f':
      return std::bit_cast<float>(cursor.take_u32());
    case 's':
      return cursor.take_text();
    default:
      return TimeTag{cursor.take_big_endian(8)};
  }
}

Message read_message(Bytes bytes) {
  Cursor cursor(bytes);
  Message message;
  message.address = cursor.take_text();
  const std::string types = cursor.take_text().substr(1);
  message.arguments.reserve(types.size());
  for (const char type : types) message.arguments.push_back(take_argument(cursor, type));
  return message;
}

}  // namespace

DecodeResult decode(Bytes bytes) {
  DecodeResult result;
  result.refusal = gate(bytes);
  if (result.refusal != Refusal::none) return result;
  if (bytes.front() != std::byte{'#'}) {
    result.packet.messages.push_back(read_message(bytes));
    return result;
  }
  Cursor cursor(bytes);
  cursor.take_text();
  result.packet.time = TimeTag{cursor.take_big_endian(8)};
  while (!cursor.at_end()) {
    const std::size_t size = cursor.take_u32();
    result.packet.messages.push_back(read_message(cursor.take(size)));
  }
  return result;
}

}  // namespace splash::protocol
