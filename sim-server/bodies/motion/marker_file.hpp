// SPDX-License-Identifier: MIT
// Optical markers as motion capture systems and OpenSim write them: TRC, tab separated.
#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "sim-server/scene/scene.hpp"

namespace splash::sim {

struct MarkerRecording {
  double rate = 0.0;               ///< frames per second [1/s]
  std::vector<std::string> names;  ///< of the markers; computed ones may lack one or share it
  std::vector<double> times;       ///< of the frames [s]
  std::vector<int> lines;          ///< of the frames in the file, counted from 1
  /// frames[frame][marker]: place in our axes (z up) [m]; nothing where the marker was not seen.
  std::vector<std::vector<std::optional<Vector3>>> frames;
};

/// Both throw program::ConfigError with line and column. The file's axes (X forward, Y up, Z
/// right) become ours: x = X, y = -Z, z = Y. Units mm, cm and m are known. Times that a file
/// rounds to milliseconds are restored from its rate. NumMarkers is not believed: what capture
/// systems compute from markers stands behind them and may not be counted.
[[nodiscard]] MarkerRecording read_markers(const std::filesystem::path& path);
[[nodiscard]] MarkerRecording parse_markers(const std::string& text, const std::string& file_name);

}  // namespace splash::sim
