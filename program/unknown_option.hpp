// SPDX-License-Identifier: MIT
// What to say of words on the command line that no option takes.
#pragma once

#include <string>
#include <vector>

namespace splash::program {

/// `words`: as they stand, at least one; `options`: all there are, with their dashes.
[[nodiscard]] std::string unknown_option(const std::vector<std::string>& words,
                                         const std::vector<std::string>& options);

}  // namespace splash::program
