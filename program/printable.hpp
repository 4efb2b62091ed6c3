// SPDX-License-Identifier: MIT
// Makes text out of a file or a packet safe for a terminal: foreign text must not move the cursor,
// clear the screen or fill it.
#pragma once

#include <cstddef>
#include <string>
#include <string_view>

namespace splash::program {

/// Returns whether the text is well-formed UTF-8 and has no control character of ASCII or Unicode
/// (U+0080 to U+009F) besides tabs and line ends.
[[nodiscard]] bool is_printable(std::string_view text) noexcept;

/// Returns the text on one line: characters that are not printable as \xNN, and "..." after
/// `longest` bytes.
[[nodiscard]] std::string printable(std::string_view text, std::size_t longest);

}  // namespace splash::program
