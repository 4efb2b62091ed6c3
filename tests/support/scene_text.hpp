// SPDX-License-Identifier: MIT
// The scenes of configs/scenes by name and as text, and a way to change a line of it in a test.
#pragma once

#include <algorithm>
#include <filesystem>
#include <fstream>
#include <sstream>
#include <stdexcept>
#include <string>
#include <vector>

#include "tests/support/source_folder.hpp"

namespace splash::tests {

inline std::filesystem::path scene_folder() {
  return source_folder() / "configs" / "scenes";
}

inline std::filesystem::path scene_file(const std::string& name) {
  return scene_folder() / (name + ".yaml");
}

/// Names of all scenes of a folder, in their order.
inline std::vector<std::string> scene_names(const std::filesystem::path& folder = scene_folder()) {
  std::vector<std::string> names;
  for (const auto& entry : std::filesystem::directory_iterator(folder)) {
    if (entry.path().extension() == ".yaml") names.push_back(entry.path().stem());
  }
  std::sort(names.begin(), names.end());
  return names;
}

/// The text of configs/scenes/`name`; throws std::runtime_error when there is no such file.
inline std::string scene_text(const std::string& name) {
  std::ifstream file(scene_folder() / name);
  std::ostringstream text;
  text << file.rdbuf();
  if (!file) throw std::runtime_error("no scene " + name);
  return text.str();
}

/// `text` with its only `from` replaced; throws std::runtime_error when there is none or another.
inline std::string changed(std::string text, const std::string& from, const std::string& to) {
  const std::size_t at = text.find(from);
  if (at == std::string::npos || text.find(from, at + 1) != std::string::npos) {
    throw std::runtime_error("not once in the scene: " + from);
  }
  return text.replace(at, from.size(), to);
}

}  // namespace splash::tests
