// SPDX-License-Identifier: MIT
// Which places are free, as bits under bits: the lowest free one is found in a few steps however
// many there are. The lowest, so that those in use stay close
// together.
#pragma once

#include <bit>
#include <cstdint>
#include <vector>

namespace splash::synth {

class FreePlaces {
 public:
  /// All `count` places are free.
  explicit FreePlaces(std::size_t count)
      : bits_((count + 63) / 64), words_((bits_.size() + 63) / 64), left_(count) {
    for (std::size_t place = 0; place < count; ++place) mark(static_cast<std::uint32_t>(place));
  }

  [[nodiscard]] bool empty() const noexcept { return left_ == 0; }

  /// Takes the lowest; not to be called when empty.
  std::uint32_t take() noexcept {
    std::size_t group = 0;
    while (words_[group] == 0) ++group;
    const std::size_t word = group * 64 + static_cast<std::size_t>(std::countr_zero(words_[group]));
    const auto bit = static_cast<std::size_t>(std::countr_zero(bits_[word]));
    bits_[word] &= bits_[word] - 1;
    if (bits_[word] == 0) words_[group] &= words_[group] - 1;
    --left_;
    return static_cast<std::uint32_t>(word * 64 + bit);
  }

  void give_back(std::uint32_t place) noexcept {
    mark(place);
    ++left_;
  }

 private:
  void mark(std::uint32_t place) noexcept {
    bits_[place / 64] |= std::uint64_t{1} << (place % 64);
    words_[place / 4096] |= std::uint64_t{1} << (place / 64 % 64);
  }

  std::vector<std::uint64_t> bits_;   ///< of each place: it is free
  std::vector<std::uint64_t> words_;  ///< of each word of bits_: it is not nil
  std::size_t left_;
};

}  // namespace splash::synth
