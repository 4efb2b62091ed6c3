// SPDX-License-Identifier: MIT
#include "tests/protocol/random_packets.hpp"

#include <array>
#include <bit>
#include <cstring>

#include "protocol/limits.hpp"

namespace splash::protocol::test {
namespace {
constexpr const char* kAddressCharacters =
    "abcdefghijklmnopqrstuvwxyzABCDEFGHIJKLMNOPQRSTUVWXYZ0123456789_.-/";
constexpr const char* kTextCharacters = "abc XYZ 019 ~!\"#$%&'()*+,-./:;<=>?@[]^_`{|}";
}  // namespace

std::string RandomPackets::text(const char* characters, std::size_t longest) {
  const auto count = static_cast<std::uint32_t>(std::strlen(characters));
  std::string out(below(static_cast<std::uint32_t>(longest) + 1), ' ');
  for (char& c : out) c = characters[below(count)];
  return out;
}

Argument RandomPackets::argument() {
  switch (below(4)) {
    case 0:
      return static_cast<std::int32_t>(word());
    case 1: {
      std::uint32_t bits = word();
      if ((bits & 0x7f800000U) == 0x7f800000U) bits ^= 0x00800000U;  // NaN or infinite: not legal
      return std::bit_cast<float>(bits);
    }
    case 2:
      return text(kTextCharacters, below(8) == 0 ? kMaxString : 9);
    default:
      return time();
  }
}

TimeTag RandomPackets::time() {
  return {static_cast<std::uint64_t>(word()) << 32U | word()};
}

Message RandomPackets::message() {
  Message out{"/" + text(kAddressCharacters, below(8) == 0 ? kMaxString - 1 : 12), {}};
  const std::uint32_t count = below(below(4) == 0 ? kMaxArguments + 1 : 5);
  for (std::uint32_t i = 0; i < count; ++i) out.arguments.push_back(argument());
  return out;
}

std::vector<Message> RandomPackets::messages() {
  std::vector<Message> out;
  std::size_t room = kMaxDatagram - 16;
  const std::uint32_t count = below(below(8) == 0 ? kMaxMessages + 1 : 5);
  for (std::uint32_t i = 0; i < count; ++i) {
    auto one = message();
    if (encoded_size(one) + 4 > room) break;
    room -= encoded_size(one) + 4;
    out.push_back(std::move(one));
  }
  return out;
}

std::vector<std::byte> RandomPackets::legal() {
  return below(3) == 0 ? encode(message()) : encode(time(), messages());
}

void RandomPackets::mutate(std::vector<std::byte>& packet) {
  if (packet.empty()) return;
  const auto size = static_cast<std::uint32_t>(packet.size());
  const auto word = static_cast<std::ptrdiff_t>(below((size + 3) / 4) * 4);
  const auto at = packet.begin() + word;
  const auto left = static_cast<std::uint32_t>(packet.end() - at);
  static constexpr std::array<std::uint8_t, 12> kBytes = {0,   1,   4,   ',', '/',  '#',
                                                          'b', '[', 's', 't', 0x7f, 0xff};
  switch (below(7)) {
    case 0:
      packet[below(size)] ^= static_cast<std::byte>(1U << below(8));
      break;
    case 1:
      packet[below(size)] = static_cast<std::byte>(kBytes[below(kBytes.size())]);
      break;
    case 2:  // a word of its own kind: sizes, numbers
      for (std::uint32_t i = 0; i < 4 && i < left; ++i) {
        packet[static_cast<std::size_t>(word) + i] =
            static_cast<std::byte>(kBytes[below(kBytes.size())]);
      }
      break;
    case 3:
      packet.resize(static_cast<std::size_t>(word));
      break;
    case 4:
      packet.insert(at, 4, static_cast<std::byte>(kBytes[below(kBytes.size())]));
      break;
    case 5:
      packet.erase(at, at + std::min<std::uint32_t>(4, left));
      break;
    default: {
      const std::vector<std::byte> tail(at, packet.end());
      packet.insert(packet.end(), tail.begin(), tail.end());
    }
  }
}

std::vector<std::byte> RandomPackets::mutated() {
  auto packet = legal();
  for (std::uint32_t i = 0, count = 1 + below(3); i < count; ++i) mutate(packet);
  packet.shrink_to_fit();  // so that a sanitizer sees a read past its end
  return packet;
}

}  // namespace splash::protocol::test
