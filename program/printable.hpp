// SPDX-License-Identifier: MIT
// Text out of a file or a packet, made fit to be shown: what a stranger wrote must not move the
// cursor, clear the screen or fill it.
#pragma once

#include <cstddef>
#include <string>
#include <string_view>

namespace splash::program {

/// True for text of printable characters, tabs and line ends: no control characters of ASCII or of
/// Unicode (U+0080 to U+009F), nothing but well-formed UTF-8.
[[nodiscard]] bool is_printable(std::string_view text) noexcept;

/// On one line: everything else than printable characters as \xNN, "..." after `longest` bytes.
[[nodiscard]] std::string printable(std::string_view text, std::size_t longest);

}  // namespace splash::program
