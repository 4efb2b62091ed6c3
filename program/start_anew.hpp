// SPDX-License-Identifier: MIT
// Re-executes the program with another configuration: the process ID stays the same, and so does
// the command line except for some options.
#pragma once

#include <string>
#include <utility>
#include <vector>

namespace splash::program {

/// Options and their values.
using OptionValues = std::vector<std::pair<std::string, std::string>>;

/// A command line in which these options have these values, whether they stood there as
/// "--scene pool" or "--scene=pool", or did not.
[[nodiscard]] std::vector<std::string> with_options(const std::vector<std::string>& line,
                                                    const OptionValues& options);

/// Replaces the process by this program with that command line. What it has open must be closed
/// before. Throws Failure (kExitUnavailable) where that cannot be done.
[[noreturn]] void start_anew(const std::vector<std::string>& line);

}  // namespace splash::program
