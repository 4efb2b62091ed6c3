// SPDX-License-Identifier: MIT
// What the sweeps found: report.md for people, cases.csv for programs.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "tests/detection/run.hpp"

namespace splash::detection {

/// A Markdown table with a row for each sweep, and one for all of them.
[[nodiscard]] std::string summary(const std::vector<Outcome>& outcomes);

/// The Markdown `text` with a row for each sweep, and for each case of a recording, in its table
/// between the lines "<!-- begin: detection-bench -->" and "<!-- end: detection-bench -->". Rows of
/// the same name are replaced; others stay unless the outcomes are those of `all` cases. Throws
/// std::runtime_error when a mark is missing.
[[nodiscard]] std::string with_rows(const std::string& text, const std::vector<Outcome>& outcomes,
                                    bool all);

/// Writes report.md and cases.csv into `folder`, which must exist. Throws std::runtime_error.
void write_report(const std::filesystem::path& folder, const std::string& device,
                  const std::vector<Outcome>& outcomes);

}  // namespace splash::detection
