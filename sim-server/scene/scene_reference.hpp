// SPDX-License-Identifier: MIT
// The reference page of the scene file, made from the same rows that read it.
#pragma once

#include <string>

namespace splash::sim {

/// Markdown: one table for each mapping of a scene file. Part of configs/README.md.
[[nodiscard]] std::string scene_reference();

}  // namespace splash::sim
