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
  /// One more item of the next panel, as gnuplot's "plot" has it.
  void add(const std::string& item);
  /// The same of columns of equal length, with what follows their name.
  void add(const std::vector<std::vector<double>>& columns, const std::string& style);
  /// Draws what was added since the last panel, one of several (multiplot).
  void panel();
  /// Draws the last panel, if there is none yet, and the picture. Throws GnuplotError.
  void draw();

 private:
  synth::ScratchFolder scratch_;
  std::ofstream script_;
  std::string items_;
  int blocks_ = 0;
};

}  // namespace splash::bench
