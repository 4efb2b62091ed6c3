// SPDX-License-Identifier: MIT
#include "tests/bench/plot.hpp"

#include <array>
#include <stdexcept>

namespace splash::bench {

const char* colour(std::size_t number) {
  static constexpr std::array kColours = {"#0072b2", "#d55e00", "#009e73",
                                          "#cc79a7", "#e69f00", "#56b4e9"};
  return kColours[number % kColours.size()];
}

Plot::Plot(const std::filesystem::path& png, int width, int height)
    : script_(scratch_.path() / "plot.gp") {
  script_ << "set terminal pngcairo size " << width << ',' << height
          << R"gp( enhanced font "DejaVu Sans,13" linewidth 1.3 background "#ffffff"
set encoding utf8
set minussign
ink = "#30343b"
set border 3 linecolor rgb ink linewidth 0.9
set tics nomirror out scale 0.6 textcolor rgb ink
set grid linecolor rgb "#dde1e7" linewidth 0.6
)gp"
          << "set output \"" << std::filesystem::absolute(png).string() << "\"\n";
}

std::string Plot::data(const std::vector<double>& x, const std::vector<double>& y) {
  std::string name = "$block" + std::to_string(blocks_++);
  script_ << name << " << EOD\n";
  for (std::size_t k = 0; k < x.size(); ++k) script_ << x[k] << ' ' << y[k] << '\n';
  script_ << "EOD\n";
  return name;
}

void Plot::draw() {
  script_.close();
  if (!script_) throw std::runtime_error("cannot write " + scratch_.path().string());
  synth::run_gnuplot(scratch_.path() / "plot.gp");
}

}  // namespace splash::bench
