// SPDX-License-Identifier: MIT
// Text for people: of numbers, fit for a terminal, not too much of it, and the name that was meant.
#pragma once

#include <cstddef>
#include <cstdint>
#include <functional>
#include <string>
#include <string_view>
#include <vector>

namespace splash::program {

// Makes text out of a file or a packet safe for a terminal: foreign text must not move the cursor,
// clear the screen or fill it.

/// Returns whether the text is well-formed UTF-8 and has no control character of ASCII or Unicode
/// (U+0080 to U+009F) besides tabs and line ends.
[[nodiscard]] bool is_printable(std::string_view text) noexcept;

/// Returns the text on one line: characters that are not printable as \xNN, and "..." after
/// `longest` bytes.
[[nodiscard]] std::string printable(std::string_view text, std::size_t longest);

/// The text with ASCII letters in lower case.
[[nodiscard]] std::string lower(const std::string& text);

// Limits how much text per second other hosts can make a program print, so that they cannot fill a
// disk.

class TextLimit {
 public:
  static constexpr double kRate = 64.0 * 1024.0;    ///< bytes per second, in the long run [1/s]
  static constexpr double kBurst = 256.0 * 1024.0;  ///< bytes at once after a rest

  /// Passes `line` to `print` if it may be printed at `now` (monotonic [s]), and before it the
  /// number of lines that were left out since the last one.
  void print(const std::string& line, double now,
             const std::function<void(const std::string&)>& print);

 private:
  double left_ = kBurst;  ///< bytes
  double filled_ = 0.0;   ///< until then [s]
  std::uint64_t left_out_ = 0;
};

/// What printf prints of the same.
[[nodiscard, gnu::format(printf, 1, 2)]] std::string format(const char* pattern, ...);

// Finds the known name nearest to a mistyped one, for "did you mean ...?".

/// Returns the known name with the fewest insertions, deletions, replacements and swaps of
/// neighbours from `wrong`; empty when that is more than a third of its length away.
[[nodiscard]] std::string nearest_name(const std::string& wrong,
                                       const std::vector<std::string>& known);

}  // namespace splash::program
