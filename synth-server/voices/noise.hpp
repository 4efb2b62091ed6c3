// SPDX-License-Identifier: MIT
// White noise without state: sample n of a burst is a function of (seed, event, n), so a replay
// gives the same bits, whatever else sounds and however blocks are cut.
#pragma once

#include <array>
#include <cstdint>
#include <numbers>

namespace splash::synth {

/// The finaliser of SplitMix64 (Steele, Lea, Flood 2014, "Fast splittable pseudorandom number
/// generators"): a bijection of 64 bits whose values at successive counters pass BigCrush.
[[nodiscard]] constexpr std::uint64_t scramble(std::uint64_t z) noexcept {
  z = (z ^ (z >> 30U)) * 0xbf58476d1ce4e5b9ULL;
  z = (z ^ (z >> 27U)) * 0x94d049bb133111ebULL;
  return z ^ (z >> 31U);
}

/// One burst's noise: uniform, mean 0, variance 1, so values in [-sqrt 3, sqrt 3).
class Noise {
 public:
  Noise() = default;
  constexpr Noise(std::uint64_t seed, std::uint64_t event) noexcept
      : key_(scramble(scramble(seed + kGolden) ^ (event * kGolden))) {}

  [[nodiscard]] constexpr double at(std::uint64_t n) const noexcept {
    const std::uint64_t bits = scramble(key_ + (n + 1) * kGolden);
    const auto whole = static_cast<std::int64_t>(bits) >> 11;  // 53 signed bits: exact in a double
    return static_cast<double>(whole) * (std::numbers::sqrt3 / 4503599627370496.0);  // 2^52
  }

  /// Of numbers 2 n and 2 n + 1 of another noise of the same kind, in single precision: for half of
  /// the work.
  [[nodiscard]] constexpr std::array<float, 2> two_at(std::uint64_t n) const noexcept {
    const std::uint64_t bits = scramble(key_ + (n + 1) * kGolden);
    constexpr auto kScale = static_cast<float>(std::numbers::sqrt3 / 2147483648.0);  // 2^31
    return {static_cast<float>(static_cast<std::int32_t>(bits >> 32U)) * kScale,
            static_cast<float>(static_cast<std::int32_t>(bits & 0xffffffffU)) * kScale};
  }

 private:
  static constexpr std::uint64_t kGolden = 0x9e3779b97f4a7c15ULL;  ///< 2^64 / golden ratio, odd
  std::uint64_t key_ = 0;
};

}  // namespace splash::synth
