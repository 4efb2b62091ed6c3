// SPDX-License-Identifier: MIT
// What is wrong on a command line.
#pragma once

#include <cmath>
#include <cstdlib>
#include <string>
#include <vector>

namespace splash::program {

// Describes words on the command line that no option takes.

/// Returns the error's text. `words`: as they stand, at least one; `options`: all options of the
/// program, with their dashes.
[[nodiscard]] std::string unknown_option(const std::vector<std::string>& words,
                                         const std::vector<std::string>& options);

// Refuses NaN on the command line, which would pass every range: it is neither below nor above any
// limit.

/// Returns what is wrong with the text of a number, as CLI11's validators do; empty: nothing.
[[nodiscard]] inline std::string refuse_nan(const std::string& text) {
  return std::isnan(std::strtod(text.c_str(), nullptr)) ? text + " is no number" : std::string();
}

}  // namespace splash::program
