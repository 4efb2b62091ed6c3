// SPDX-License-Identifier: MIT
// Rig files: what may stand in them, and how they become a Rig.
#pragma once

#include <filesystem>
#include <string>

#include "synth-server/output/rig.hpp"

namespace splash::synth {

/// Throws program::ConfigError: file, line, column, key, value, range and cure.
[[nodiscard]] Rig read_rig(const std::filesystem::path& path);
/// The same from text; `file_name` is what errors call it.
[[nodiscard]] Rig parse_rig(const std::string& text, const std::string& file_name);

/// The keys of a rig file as Markdown, for the manual.
[[nodiscard]] std::string describe_rig_keys();

}  // namespace splash::synth
