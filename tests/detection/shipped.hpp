// SPDX-License-Identifier: MIT
// The scenes of configs/scenes as text.
#pragma once

#include <filesystem>
#include <string>

namespace splash::detection {

[[nodiscard]] std::filesystem::path scene_folder();
/// Throws std::runtime_error.
[[nodiscard]] std::string shipped(const std::string& name);
/// With its only `from` replaced; throws std::runtime_error when there is none or another.
[[nodiscard]] std::string changed(std::string text, const std::string& from, const std::string& to);
/// Without the line that makes waves on a standing body impacts, if there is one.
[[nodiscard]] std::string without_wave_impacts(const std::string& text);

}  // namespace splash::detection
