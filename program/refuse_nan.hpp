// SPDX-License-Identifier: MIT
// NaN on the command line passes every range, since it is neither below nor above a limit.
#pragma once

#include <cmath>
#include <cstdlib>
#include <string>

namespace splash::program {

/// What is wrong with the text of a number, as command-line parsers ask it; empty: nothing.
[[nodiscard]] inline std::string refuse_nan(const std::string& text) {
  return std::isnan(std::strtod(text.c_str(), nullptr)) ? text + " is no number" : std::string();
}

}  // namespace splash::program
