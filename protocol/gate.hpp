// SPDX-License-Identifier: MIT
// The strict packet filter in front of every OSC parser: a packet can crash or hang Debian's
// oscpack and liblo, so they see only packets that this filter has accepted.
#pragma once

#include <cstddef>
#include <span>
#include <string_view>

namespace splash::protocol {

using Bytes = std::span<const std::byte>;

/// Why a datagram was refused. `none` means accepted.
enum class Refusal {
  none,
  empty,
  too_long,     ///< over kMaxDatagram
  not_aligned,  ///< length no multiple of four
  bad_address,  ///< not [a-z0-9/_.A-Z-], not closed, over kMaxString: patterns are refused
  bad_tags,     ///< a type besides i f s t, or no type string
  too_many_arguments,
  truncated,    ///< an argument or element passes the end
  bad_padding,  ///< a padding byte that is not zero
  not_finite,   ///< a float that is NaN or infinite
  bad_string,   ///< not printable, or over kMaxString
  bad_element,  ///< a bundle element of size zero, odd or past the end
  nested,       ///< a bundle inside a bundle
  too_many_messages,
  left_over,  ///< bytes behind the last argument
  count_      ///< number of reasons
};

/// Returns whether, or why not, `packet` is a message or a one-level bundle of messages within all
/// limits. It never throws or allocates, and reads each byte at most a few times.
[[nodiscard]] Refusal gate(Bytes packet) noexcept;

/// The reason in words, for logs and counters.
[[nodiscard]] std::string_view describe(Refusal refusal) noexcept;

}  // namespace splash::protocol
