// SPDX-License-Identifier: MIT
// Finds the known name nearest to a mistyped one, for "did you mean ...?".
#pragma once

#include <string>
#include <vector>

namespace splash::program {

/// Returns the known name with the fewest insertions, deletions, replacements and swaps of
/// neighbours from `wrong`; empty when that is more than a third of its length away.
[[nodiscard]] std::string nearest_name(const std::string& wrong,
                                       const std::vector<std::string>& known);

}  // namespace splash::program
