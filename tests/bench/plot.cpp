// SPDX-License-Identifier: MIT
#include "tests/bench/plot.hpp"

#include <array>
#include <stdexcept>
#include <utility>

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

void Plot::add(const std::string& item) {
  items_ += (items_.empty() ? "" : ", ") + item;
}

void Plot::add(const std::vector<std::vector<double>>& columns, const std::string& style) {
  const std::string name = "$block" + std::to_string(blocks_++);
  script_ << name << " << EOD\n";
  for (std::size_t k = 0; k < columns.front().size(); ++k) {
    for (const std::vector<double>& column : columns) script_ << column[k] << ' ';
    script_ << '\n';
  }
  script_ << "EOD\n";
  add(name + ' ' + style);
}

void Plot::panel() {
  script_ << "plot " << std::exchange(items_, {}) << '\n';
}

void Plot::draw() {
  if (!items_.empty()) panel();
  script_ << "unset multiplot\n";
  script_.close();
  if (!script_) throw std::runtime_error("cannot write " + scratch_.path().string());
  synth::run_gnuplot(scratch_.path() / "plot.gp");
}

}  // namespace splash::bench
