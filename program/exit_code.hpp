// SPDX-License-Identifier: MIT
// How our programs end: with an exit code, and a sentence on standard error if it is not 0.
#pragma once

#include <functional>

namespace splash::program {

/// Calls `run` and returns the exit code of the program. An exception that ends it is printed to
/// standard error: after the name `program`, unless its text begins with a file and a line.
[[nodiscard]] int exit_code_of(const char* program, const std::function<void()>& run);

}  // namespace splash::program
