// SPDX-License-Identifier: MIT
// "Did you mean ...?": the known name nearest to a mistyped one.
#pragma once

#include <string>
#include <vector>

namespace splash::program {

/// The known name with the fewest insertions, deletions, replacements and swaps of neighbours from
/// `wrong`; empty when even that one is more than a third of its length away.
[[nodiscard]] std::string nearest_name(const std::string& wrong,
                                       const std::vector<std::string>& known);

}  // namespace splash::program
