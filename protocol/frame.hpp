// SPDX-License-Identifier: MIT
// The format of viewers' frames (view-server/README.md): a kind, the frame's size, a moment, and
// numbers, all little endian.
#pragma once

#include <bit>
#include <concepts>
#include <cstddef>
#include <cstdint>
#include <span>
#include <string_view>
#include <type_traits>
#include <utility>
#include <vector>

namespace splash::protocol {

using ViewFrame = std::vector<std::byte>;

inline constexpr std::size_t kFrameHead = 16;              ///< bytes: kind, size, moment
inline constexpr std::uint32_t kLargestFrame = 1U << 28U;  ///< bytes

inline constexpr std::string_view kSceneFrame = "SPC1";
inline constexpr std::string_view kStateFrame = "SPS1";
inline constexpr std::string_view kRigFrame = "SPR1";
inline constexpr std::string_view kLevelsFrame = "SPL1";
inline constexpr std::string_view kSoundFrame = "SPA1";

/// The unsigned integer of a number's size.
template <class Number>
using FrameBits = std::conditional_t<
    sizeof(Number) == 8, std::uint64_t,
    std::conditional_t<sizeof(Number) == 4, std::uint32_t,
                       std::conditional_t<sizeof(Number) == 2, std::uint16_t, std::uint8_t>>>;

class FrameWriter {
 public:
  /// `kind`: four characters; `moment`: Unix time [s].
  FrameWriter(std::string_view kind, double moment) {
    text(kind);
    put(std::uint32_t{0});
    put(moment);
  }

  template <class Number>
  requires std::integral<Number> || std::floating_point<Number>
  void put(Number value) { store(std::bit_cast<FrameBits<Number>>(value), sizeof(Number)); }
  template <class Number>
  void put_all(std::span<const Number> values) {
    std::size_t at = bytes_.size();
    if constexpr (std::endian::native == std::endian::little) {
      const auto bytes = std::as_bytes(values);
      bytes_.insert(bytes_.end(), bytes.begin(), bytes.end());
      return;
    }
    bytes_.resize(at + values.size_bytes());
    for (const Number value : values) {
      const auto bits = std::bit_cast<FrameBits<Number>>(value);
      for (std::size_t i = 0; i < sizeof bits; ++i) {
        bytes_[at + i] = static_cast<std::byte>(bits >> (8 * i));
      }
      at += sizeof bits;
    }
  }
  void text(std::string_view text) {
    const auto* bytes = reinterpret_cast<const std::byte*>(text.data());
    bytes_.insert(bytes_.end(), bytes, bytes + text.size());
  }
  /// Reserves memory for `more` bytes that follow.
  void reserve(std::size_t more) { bytes_.reserve(bytes_.size() + more); }

  /// Writes the frame's size and returns the frame.
  [[nodiscard]] ViewFrame take() && {
    const auto size = static_cast<std::uint32_t>(bytes_.size());
    for (std::size_t i = 0; i < 4; ++i) bytes_[4 + i] = static_cast<std::byte>(size >> (8 * i));
    return std::move(bytes_);
  }

 private:
  void store(std::uint64_t bits, std::size_t size) {
    const std::size_t at = bytes_.size();
    bytes_.resize(at + size);
    for (std::size_t i = 0; i < size; ++i) bytes_[at + i] = static_cast<std::byte>(bits >> (8 * i));
  }

  ViewFrame bytes_;
};

/// Reads a little-endian number of a frame.
template <class Number>
[[nodiscard]] Number frame_number(const std::byte* bytes) noexcept {
  using Bits = FrameBits<Number>;
  Bits bits = 0;
  for (std::size_t i = 0; i < sizeof(Number); ++i) {
    bits = static_cast<Bits>(bits | static_cast<Bits>(bytes[i]) << (8 * i));
  }
  return std::bit_cast<Number>(bits);
}

/// The frame's kind: its first four characters.
[[nodiscard]] inline std::string_view frame_kind(const std::byte* frame) noexcept {
  return {reinterpret_cast<const char*>(frame), 4};
}

}  // namespace splash::protocol
