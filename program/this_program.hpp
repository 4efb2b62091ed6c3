// SPDX-License-Identifier: MIT
// The running program: its file, and how it starts anew.
#pragma once

#include <filesystem>
#include <string>
#include <utility>
#include <vector>

namespace splash::program {

// Finds the file of the running program, since the files that belong to it lie beside it.

/// Returns the file that starts this program again: its own, or the one that $SPLASH_PROGRAM names
/// when the process is a dynamic loader that was given the program, as in a bundle (./splash
/// bundle); "" when /proc is not mounted.
[[nodiscard]] std::filesystem::path this_program();

// Re-executes the program with another configuration: the process ID stays the same, and so does
// the command line except for some options.

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
