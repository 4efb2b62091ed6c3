// SPDX-License-Identifier: MIT
// Where the program that runs lies: what belongs to it lies beside it.
#pragma once

#include <filesystem>

namespace splash::program {

/// What starts this program anew: its own file, or what $SPLASH_PROGRAM names where the process is
/// a dynamic loader that was given the program, as in a bundle (./splash bundle); "" where /proc is
/// not mounted.
[[nodiscard]] std::filesystem::path this_program();

}  // namespace splash::program
