// SPDX-License-Identifier: MIT
// A seeded source of packets: legal ones, and legal ones with some bytes broken.
#pragma once

#include <cstdint>
#include <random>

#include "protocol/message.hpp"

namespace splash::protocol::test {

class RandomPackets {
 public:
  explicit RandomPackets(std::uint32_t seed) : random_(seed) {}
  [[nodiscard]] Message message();
  [[nodiscard]] std::vector<Message> messages();
  [[nodiscard]] TimeTag time();
  /// A legal bundle or bare message.
  [[nodiscard]] std::vector<std::byte> legal();
  /// The same after one to three mutations: bits, words, cuts, repeats, insertions.
  [[nodiscard]] std::vector<std::byte> mutated();

 private:
  std::uint32_t below(std::uint32_t limit) { return word() % limit; }
  std::uint32_t word() { return static_cast<std::uint32_t>(random_()); }
  [[nodiscard]] Argument argument();
  [[nodiscard]] std::string text(const char* characters, std::size_t longest);
  void mutate(std::vector<std::byte>& packet);

  std::mt19937 random_;
};

}  // namespace splash::protocol::test
