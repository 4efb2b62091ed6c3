// SPDX-License-Identifier: MIT
// The cases of all sweeps: a scene each, and what may be heard in it.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "tests/detection/recording.hpp"
#include "tests/detection/score.hpp"

namespace splash::detection {

struct Case {
  std::string sweep;
  std::string name;
  std::string scene;     ///< YAML
  double seconds = 1.0;  ///< simulated
  Wishes wishes = {};    ///< its level is the scene's
  bool quick = false;    ///< one of the few that stand for all
  bool feet = false;     ///< bodies are feet that roll in
  double pulled = 0.0;   ///< meets the water that it pulled up so long before the level [s]
  std::filesystem::path tracker = {};  ///< a marker file for bodies of kind trc, or empty
  /// Foot contacts as tests/data/walk_contacts.csv has them, all wanted; or empty.
  std::filesystem::path truth = {};
};

/// What recordings to play, and where files may be put.
struct Material {
  std::filesystem::path folder;  ///< must exist; meshes and played recordings are written there
  Walk walk;
  std::vector<HandRecording> hands;
};

[[nodiscard]] std::vector<Case> all_cases(const Material& material);

/// By what part they are of all_cases.
[[nodiscard]] std::vector<Case> plunge_cases(const std::filesystem::path& folder);
[[nodiscard]] std::vector<Case> repeated_cases();
[[nodiscard]] std::vector<Case> silent_cases();
[[nodiscard]] std::vector<Case> cavity_cases();
[[nodiscard]] std::vector<Case> scene_cases();
[[nodiscard]] std::vector<Case> recorded_cases(const Material& material);

}  // namespace splash::detection
