// SPDX-License-Identifier: MIT
// Parses numbers and truth values of configurations strictly: each has one spelling.
#pragma once

#include <optional>
#include <string>

namespace splash::program {

/// Parses a finite decimal number: sign, digits, point, exponent. Refuses 010, 0x10, 1_000, .inf
/// and .nan.
[[nodiscard]] std::optional<double> parse_number(const std::string& text);
/// Parses a whole number without point or exponent.
[[nodiscard]] std::optional<int> parse_whole(const std::string& text);
/// Parses true or false.
[[nodiscard]] std::optional<bool> parse_truth(const std::string& text);
/// Returns what to write instead of a text that none of the above accepts; "": there is no advice.
[[nodiscard]] std::string number_advice(const std::string& text);

}  // namespace splash::program
