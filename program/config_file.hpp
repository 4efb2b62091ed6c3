// SPDX-License-Identifier: MIT
// Scenes, rigs and sounds by name: `--scene pool` is the file pool.yaml wherever scenes lie.
#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

namespace splash::program {

/// Where files of `kind` ("scenes", "rigs", "sounds") are looked for, in this order: the user's own
/// folder, $XDG_CONFIG_HOME/splash/<kind> (~/.config where that is not set), and the one that
/// belongs to the program, share/splash/configs/<kind> beside its bin/, built or installed.
[[nodiscard]] std::vector<std::filesystem::path> config_folders(const std::string& kind);

/// <name>.yaml in the first of config_folders() that has one, never a file elsewhere: `name` is a
/// name, no path.
[[nodiscard]] std::optional<std::filesystem::path> named_config(const std::string& kind,
                                                                const std::string& name);

/// A configuration that is found by its name, and what it says of itself.
struct NamedConfig {
  std::string name;
  std::string description;  ///< its line `description:`, or empty
};
/// All of a kind, by name; of those with the same name the one that counts.
[[nodiscard]] std::vector<NamedConfig> list_configs(const std::string& kind);

/// The file that `wanted` means: itself where it is a file or names a folder, else <wanted>.yaml in
/// the first of config_folders() that has one. It can be read.
/// Throws Failure (kExitNoInput): `option`, the cause, the nearest name and all names there are.
[[nodiscard]] std::filesystem::path find_config(const std::string& option, const std::string& kind,
                                                const std::filesystem::path& wanted);

}  // namespace splash::program
