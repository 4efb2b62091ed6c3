// SPDX-License-Identifier: MIT
// Numbers and truth values as configurations write them: one spelling each, nothing guessed.
#pragma once

#include <optional>
#include <string>

namespace splash::program {

/// A finite decimal number: sign, digits, point, exponent. Not: 010, 0x10, 1_000, .inf, .nan.
[[nodiscard]] std::optional<double> parse_number(const std::string& text);
/// A whole number without point or exponent.
[[nodiscard]] std::optional<int> parse_whole(const std::string& text);
/// true or false.
[[nodiscard]] std::optional<bool> parse_truth(const std::string& text);
/// What to write instead of a text that is none of the above; "" when there is nothing to say.
[[nodiscard]] std::string number_advice(const std::string& text);

}  // namespace splash::program
