// SPDX-License-Identifier: MIT
// A YAML file as a sound. Keys that are missing take the paper's values.
#pragma once

#include <filesystem>
#include <string>

#include "synth-server/sound/sound_rows.hpp"

namespace splash::synth {

/// Throws program::ConfigError with file, line and column.
[[nodiscard]] NamedSound read_sound(const std::filesystem::path& path);
[[nodiscard]] NamedSound parse_sound(const std::string& text, const std::string& file_name);

/// All keys as Markdown tables: the reference in configs/sounds/README.md.
[[nodiscard]] std::string describe_sound_keys();

}  // namespace splash::synth
