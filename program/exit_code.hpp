// SPDX-License-Identifier: MIT
// How our programs end: with an exit code, and a sentence on standard error if it is not 0.
#pragma once

#include <functional>

namespace splash::program {

/// Runs a program, of the name `program`. Returns its exit code; the error that ended it is told on
/// standard error, behind the program's name if it does not begin with a file and a line.
[[nodiscard]] int exit_code_of(const char* program, const std::function<void()>& run);

}  // namespace splash::program
