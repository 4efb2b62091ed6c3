// SPDX-License-Identifier: MIT
// Marker recordings played otherwise than they were made: mirrored, backwards, upside down, faster.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "sim-server/bodies/motion/marker_file.hpp"

namespace splash::detection {

struct Play {
  bool mirrored = false;   ///< left and right change sides
  bool backwards = false;  ///< in time
  bool over = false;       ///< upside down, the lowest place the highest before
  double pace = 1.0;       ///< so many times as fast
};

/// It begins at time 0.
[[nodiscard]] sim::MarkerRecording played(sim::MarkerRecording recording, const Play& play);

/// As a TRC file in millimetres. Throws std::runtime_error.
void write_trc(const sim::MarkerRecording& recording, const std::filesystem::path& path);

/// The region that markers move in [m]; throws std::invalid_argument where none is seen.
struct Region {
  sim::Vector3 lower = {0.0, 0.0, 0.0};
  sim::Vector3 upper = {0.0, 0.0, 0.0};
};
[[nodiscard]] Region region_of(const sim::MarkerRecording& recording,
                               const std::vector<std::string>& markers);

/// Two feet over a floor at height 0.
struct Walk {
  std::filesystem::path file;
  std::vector<std::string> left, right;  ///< markers, heel and toe first
  std::filesystem::path contacts;        ///< truth of a walk in a thin layer, or empty
};

/// The walk that the tests have, with what force plates saw of it.
[[nodiscard]] Walk own_walk();

/// One body that goes into the water by hand.
struct HandRecording {
  std::filesystem::path file;
  std::vector<std::string> markers;
  sim::Vector3 size = {0.18, 0.09, 0.04};  ///< of its box [m]
};

}  // namespace splash::detection
