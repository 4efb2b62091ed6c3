// SPDX-License-Identifier: MIT
// A marker recording of a body that stands, but for its last frames.
#pragma once

#include <unistd.h>

#include <filesystem>
#include <fstream>
#include <sstream>
#include <string>
#include <system_error>

namespace splash::sim::test {

/// A TRC file that is removed with this: four markers 0.02 s apart, data from line 6 on. In the
/// fourth frame and after it all of them are `jump` metres higher.
class MarkerText {
 public:
  MarkerText(const std::string& names, int frames, double jump)
      : path_(std::filesystem::temp_directory_path() /
              ("markers-" + std::to_string(++count()) + "-" + std::to_string(getpid()) + ".trc")) {
    std::ostringstream text;
    text << "PathFileType\t4\t(X/Y/Z)\ta.trc\nDataRate\tNumFrames\tNumMarkers\tUnits\n50\t"
         << frames << "\t4\tm\nFrame#\tTime\t" << names << "\n\t\tX1\tY1\tZ1\n";
    for (int k = 0; k < frames; ++k) {
      const double y = k < 3 ? 0.0 : jump;
      text << k + 1 << '\t' << 0.02 * k << "\t0\t" << y << "\t0\t0.2\t" << y << "\t0\t0.1\t" << y
           << "\t0.1\t0\t0\t0\n";
    }
    std::ofstream(path_) << text.str();
  }
  ~MarkerText() {
    std::error_code ignored;
    std::filesystem::remove(path_, ignored);
  }
  MarkerText(const MarkerText&) = delete;
  MarkerText& operator=(const MarkerText&) = delete;

  [[nodiscard]] const std::filesystem::path& path() const noexcept { return path_; }

 private:
  static int& count() {
    static int files = 0;
    return files;
  }
  std::filesystem::path path_;
};

}  // namespace splash::sim::test
