// SPDX-License-Identifier: MIT
// What the cases change in the scenes of configs/scenes.
#pragma once

#include <string>

#include "tests/support/scene_text.hpp"

namespace splash::detection {

using tests::changed;
using tests::scene_folder;
using tests::scene_text;

/// Without the line that makes waves on a standing body impacts, if there is one.
[[nodiscard]] std::string without_wave_impacts(const std::string& text);

}  // namespace splash::detection
