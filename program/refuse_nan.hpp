// SPDX-License-Identifier: MIT
// Refuses NaN on the command line, which would pass every range: it is neither below nor above any
// limit.
#pragma once

#include <cmath>
#include <cstdlib>
#include <string>

namespace splash::program {

/// Returns what is wrong with the text of a number, as CLI11's validators do; empty: nothing.
[[nodiscard]] inline std::string refuse_nan(const std::string& text) {
  return std::isnan(std::strtod(text.c_str(), nullptr)) ? text + " is no number" : std::string();
}

}  // namespace splash::program
