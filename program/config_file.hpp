// SPDX-License-Identifier: MIT
// Finds scenes, rigs and sounds by name: `--scene pool` is the file pool.yaml in a folder of
// scenes.
#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

namespace splash::program {

/// The folders that are searched for files of `kind` ("scenes", "rigs", "sounds"), in this order:
/// the user's own, $XDG_CONFIG_HOME/splash/<kind> (~/.config where that is not set), and the
/// program's, share/splash/configs/<kind> beside its bin/, built or installed.
[[nodiscard]] std::vector<std::filesystem::path> config_folders(const std::string& kind);

/// Returns <name>.yaml in the first of config_folders() that has one, never a file elsewhere:
/// `name` is a name and no path.
[[nodiscard]] std::optional<std::filesystem::path> named_config(const std::string& kind,
                                                                const std::string& name);

/// A configuration that is found by its name, and what it says of itself.
struct NamedConfig {
  std::string name;
  std::string description;  ///< its line `description:`, or empty
};
/// All of a kind, by name; of those with the same name the one that counts.
[[nodiscard]] std::vector<NamedConfig> list_configs(const std::string& kind);

/// Returns the readable file that `wanted` means: itself where it is a file or contains a folder,
/// else <wanted>.yaml in the first of config_folders() that has one. Throws Failure (kExitNoInput)
/// with `option`, the cause, the nearest name and all known names.
[[nodiscard]] std::filesystem::path find_config(const std::string& option, const std::string& kind,
                                                const std::filesystem::path& wanted);

}  // namespace splash::program
