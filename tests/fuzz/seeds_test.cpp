// SPDX-License-Identifier: MIT
// The seeds and mutations of them through every reader, under sanitizers: what ./splash bench fuzz
// does for hours, for seconds.
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cctype>
#include <cstdio>
#include <random>
#include <string>

#include "tests/fuzz/target.hpp"

namespace splash::fuzz {
namespace {

/// Mutants of each target, a million in all: most where an input takes microseconds.
int mutants(const std::string& target) {
  if (target == "gate") return 640000;
  if (target == "packet") return 270000;
  if (target == "tracker") return 60000;
  if (target == "tuio" || target == "pressure") return 30000;
  return target == "scene" || target == "rig" ? 3000 : 12000;
}

/// As C writes a string, so that a failure can be taken over into a test.
std::string quoted(Bytes input) {
  std::string text;
  for (const auto byte : input) {
    const auto c = std::to_integer<unsigned char>(byte);
    std::array<char, 5> code{};
    std::snprintf(code.data(), code.size(), "\\x%02x", c);
    text += std::isalnum(c) != 0 ? std::string(1, static_cast<char>(c)) : code.data();
  }
  return text;
}

class Mutations {
 public:
  explicit Mutations(std::uint32_t seed) : random_(seed) {}

  std::vector<std::byte> of(const std::vector<std::vector<std::byte>>& seeds, std::size_t longest) {
    auto input = seeds[below(seeds.size())];
    for (std::size_t i = 1 + below(4); i > 0; --i) change(input, seeds[below(seeds.size())]);
    if (input.size() > longest) input.resize(longest);
    return input;
  }

 private:
  std::size_t below(std::size_t limit) { return random_() % limit; }
  std::byte byte() {
    static constexpr std::array<unsigned, 14> kTelling = {0,   1,   4,   ',',  '/',  '#',  '[',
                                                          ':', '-', '"', '\n', 0x7f, 0x80, 0xff};
    return static_cast<std::byte>(below(3) == 0 ? kTelling[below(kTelling.size())] : below(256));
  }
  /// A stretch of 4, since packets are made of words, or of any length.
  std::size_t length(std::size_t most) {
    return std::min(most, below(2) == 0 ? 4 * (1 + below(4)) : 1 + below(24));
  }
  void change(std::vector<std::byte>& input, const std::vector<std::byte>& other) {
    if (input.empty()) return input.push_back(byte());
    const std::size_t place = below(2) == 0 ? below(input.size()) : below(input.size()) / 4 * 4;
    const auto at = input.begin() + static_cast<std::ptrdiff_t>(place);
    const auto count = static_cast<std::ptrdiff_t>(length(input.size() - place));
    switch (below(5)) {
      case 0:
        *at = byte();
        break;
      case 1:
        *at ^= static_cast<std::byte>(1U << below(8));
        break;
      case 2:
        input.erase(at, at + count);
        break;
      case 3:
        input.insert(at, static_cast<std::size_t>(count), byte());
        break;
      default:
        splice(input, at, other);
    }
  }
  void splice(std::vector<std::byte>& input, std::vector<std::byte>::iterator at,
              const std::vector<std::byte>& other) {
    if (other.empty()) return;
    const auto from = static_cast<std::ptrdiff_t>(below(other.size()) / 4 * 4);
    const std::vector<std::byte> piece(other.begin() + from, other.end());
    input.erase(at, input.end());
    input.insert(input.end(), piece.begin(), piece.end());
  }

  std::mt19937 random_;
};

/// What the reader says of an input; a failure of the test when it breaks a promise.
bool accepts(const Target& target, Bytes input) {
  try {
    return target.try_input(input);
  } catch (const std::exception& broken) {
    ADD_FAILURE() << target.name << ": " << broken.what() << "\ninput: " << quoted(input);
    return false;
  }
}

class Fuzz : public testing::TestWithParam<std::string> {
 protected:
  [[nodiscard]] static const Target& target() {
    return *std::find_if(targets().begin(), targets().end(),
                         [](const Target& one) { return one.name == GetParam(); });
  }
};

TEST_P(Fuzz, SeedsAreReadAsPromised) {
  const auto seeds = read_seeds(target());
  ASSERT_GE(seeds.size(), 5U);
  const auto accepted = std::count_if(seeds.begin(), seeds.end(),
                                      [](const auto& seed) { return accepts(target(), seed); });
  EXPECT_GE(accepted, 3) << "seeds that nobody accepts lead nowhere";
}

TEST_P(Fuzz, MutationsOfThemAreReadAsPromised) {
  const auto seeds = read_seeds(target());
  Mutations mutations(1);
  const int count = mutants(target().name);
  int accepted = 0;
  for (int i = 0; i < count && !HasFailure(); ++i) {
    accepted += accepts(target(), mutations.of(seeds, target().longest)) ? 1 : 0;
  }
  RecordProperty("accepted", accepted);
  EXPECT_GE(accepted, count / 100) << "too few get past the first check";
  EXPECT_LE(accepted, count * 95 / 100) << "the mutations break too little";
}

std::string name_of(const testing::TestParamInfo<std::string>& info) {
  return info.param;
}

INSTANTIATE_TEST_SUITE_P(Readers, Fuzz,
                         testing::Values("gate", "packet", "intake", "log", "scene", "rig", "mesh",
                                         "tracker", "tuio", "pressure"),
                         name_of);

}  // namespace
}  // namespace splash::fuzz
