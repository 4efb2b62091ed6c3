// SPDX-License-Identifier: MIT
// One picture per case: what was measured or is known, and the runs at each resolution.
#pragma once

#include <filesystem>

#include "tests/validation/cases.hpp"

namespace splash::validation {

/// Draws into `file` (PNG) with gnuplot. `curves`: of all resolutions, with their titles. Throws
/// std::runtime_error.
void draw(const std::filesystem::path& file, const Case& item, const std::vector<Curve>& curves);

}  // namespace splash::validation
