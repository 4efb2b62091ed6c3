// SPDX-License-Identifier: MIT
// The sound for the Pd patches, from the rows of its file and the shipped sounds: what each number
// is, boxes to set it, presets, and the level at which a rig's impacts are felt. A test holds the
// patches to it.
#pragma once

#include <filesystem>
#include <map>
#include <string>

namespace splash::synth {

/// The generated patches by the names of their files. `configs`: the folder of rigs and sounds.
/// Throws program::ConfigError where a sound or rig there is wrong.
[[nodiscard]] std::map<std::string, std::string> pd_sound(const std::filesystem::path& configs);

}  // namespace splash::synth
