// SPDX-License-Identifier: MIT
// Gauges written to a CSV file, a line per sample.
#pragma once

#include <filesystem>
#include <fstream>
#include <string>

#include "sim-server/gauge/gauges.hpp"

namespace splash::sim {

class GaugeFile {
 public:
  /// Opens the file and writes the columns' names. Throws std::invalid_argument when the scene
  /// names no gauges, program::WriteError when the file cannot be written.
  GaugeFile(const std::filesystem::path& path, const Scene& scene);

  /// Writes a sample if one is due at `seconds`, the end of a frame. Throws program::WriteError.
  void note(double seconds, Fluid& fluid, const Bodies& bodies);
  /// Begins a new file at the same path, with the columns' names. Throws program::WriteError.
  void reopen();

 private:
  std::filesystem::path path_;
  Gauges gauges_;
  std::ofstream out_;
};

}  // namespace splash::sim
