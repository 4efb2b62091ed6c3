// SPDX-License-Identifier: MIT
// Finds the file of the running program, since the files that belong to it lie beside it.
#pragma once

#include <filesystem>

namespace splash::program {

/// Returns the file that starts this program again: its own, or the one that $SPLASH_PROGRAM names
/// when the process is a dynamic loader that was given the program, as in a bundle (./splash
/// bundle); "" when /proc is not mounted.
[[nodiscard]] std::filesystem::path this_program();

}  // namespace splash::program
