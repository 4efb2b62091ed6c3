// SPDX-License-Identifier: MIT
// From a scene file to a Scene that can be simulated, or an error that says where and why not.
#pragma once

#include <filesystem>
#include <string>

#include "sim-server/scene/scene.hpp"

namespace splash::sim {

/// Both throw program::ConfigError. Files named in the scene are taken relative to its folder and
/// must exist; quaternions come back with unit length; a scripted body rests at its first keyframe.
[[nodiscard]] Scene read_scene(const std::filesystem::path& path);
[[nodiscard]] Scene parse_scene(const std::string& text, const std::string& file_name);

// The reference page of the scene file, made from the same rows that read it.

/// Markdown: one table for each mapping of a scene file. Part of configs/README.md.
[[nodiscard]] std::string scene_reference();

}  // namespace splash::sim
