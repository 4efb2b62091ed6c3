// SPDX-License-Identifier: MIT
// Describes words on the command line that no option takes.
#pragma once

#include <string>
#include <vector>

namespace splash::program {

/// Returns the error's text. `words`: as they stand, at least one; `options`: all options of the
/// program, with their dashes.
[[nodiscard]] std::string unknown_option(const std::vector<std::string>& words,
                                         const std::vector<std::string>& options);

}  // namespace splash::program
