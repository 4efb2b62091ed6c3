// SPDX-License-Identifier: MIT
// Command lines: read, and what is wrong on them.
#pragma once

#include <cmath>
#include <cstdlib>
#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "program/failure.hpp"

// NOLINTNEXTLINE(readability-identifier-naming)  CLI11 is not read by those who read options
namespace CLI {
class App;
}  // namespace CLI

namespace splash::program {

/// What the command line says: options, or the code to exit with (help and errors are printed).
template <class Options>
struct Parsed {
  std::optional<Options> options;
  int exit_code = kExitOk;
};

/// Reads a command line as `app` describes it, then calls `take`, which refuses options by
/// std::invalid_argument. Returns the code to exit with (help and errors are printed), or none.
[[nodiscard]] std::optional<int> read_command_line(
    CLI::App& app, int argc, const char* const* argv, const std::function<void()>& take = [] {});

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
