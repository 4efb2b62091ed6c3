// SPDX-License-Identifier: MIT
// One picture by gnuplot, in the style that all reports share.
#pragma once

#include <filesystem>
#include <fstream>
#include <string>
#include <vector>

#include "synth-server/figure/gnuplot.hpp"

namespace splash::bench {

/// Colours that people with colour blindness tell apart: Okabe and Ito 2008. "#rrggbb"
[[nodiscard]] const char* colour(std::size_t number);

class Plot {
 public:
  /// A PNG of so many pixels. Throws std::runtime_error.
  Plot(const std::filesystem::path& png, int width, int height);

  /// gnuplot's commands; `ink` is the colour of text.
  std::ostream& script() { return script_; }
  /// Points as a data block: its name, for "plot".
  std::string data(const std::vector<double>& x, const std::vector<double>& y);
  /// Throws GnuplotError.
  void draw();

 private:
  synth::ScratchFolder scratch_;
  std::ofstream script_;
  int blocks_ = 0;
};

}  // namespace splash::bench
