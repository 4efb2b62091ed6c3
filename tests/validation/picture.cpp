// SPDX-License-Identifier: MIT
#include "tests/validation/picture.hpp"

#include <fstream>
#include <stdexcept>

#include "synth-server/figure/gnuplot.hpp"

namespace splash::validation {

namespace {

// Colours that people with colour blindness tell apart: Okabe and Ito 2008.
constexpr const char* kColours[] = {"#0072b2", "#d55e00", "#009e73", "#cc79a7",
                                    "#e69f00", "#56b4e9", "#000000"};
constexpr std::size_t kColourCount = std::size(kColours);

constexpr const char* kSetup = R"gp(
set terminal pngcairo size 1000,640 enhanced font "DejaVu Sans,13" linewidth 1.3 \
  background "#ffffff"
set encoding utf8
set minussign
ink = "#30343b"
set border 3 linecolor rgb ink linewidth 0.9
set tics nomirror out scale 0.6 textcolor rgb ink
set grid linecolor rgb "#dde1e7" linewidth 0.6
set bmargin 7
set key at screen 0.5, 0.02 bottom center horizontal maxrows 2 noenhanced \
  textcolor rgb ink samplen 2
)gp";

void write_data(const std::filesystem::path& path, const Curve& curve) {
  std::ofstream out(path);
  for (std::size_t k = 0; k < curve.x.size(); ++k) out << curve.x[k] << ' ' << curve.y[k] << '\n';
  if (!out) throw std::runtime_error("cannot write " + path.string());
}

}  // namespace

void draw(const std::filesystem::path& file, const Case& item, const std::vector<Curve>& curves) {
  const synth::ScratchFolder folder;
  const std::filesystem::path script = folder.path() / "case.gp";
  std::ofstream out(script);
  out << kSetup << "set output \"" << std::filesystem::absolute(file).string() << "\"\n"
      << "set title \"" << item.title << "\" noenhanced textcolor rgb ink\n"
      << "set xlabel \"" << item.x_label << "\" noenhanced textcolor rgb ink\n"
      << "set ylabel \"" << item.y_label << "\" noenhanced textcolor rgb ink\nplot ";
  const std::vector<Curve> known = item.reference();
  std::size_t number = 0;
  const auto plot = [&](const Curve& curve, const std::string& style) {
    const std::string name = "curve" + std::to_string(number) + ".dat";
    write_data(folder.path() / name, curve);
    out << (number == 0 ? "" : ", ") << '"' << (folder.path() / name).string() << "\" with "
        << style << " title \"" << curve.title << '"';
    ++number;
  };
  for (const Curve& curve : curves) {
    plot(curve, "lines linewidth 1.6 linecolor rgb \"" +
                    std::string(kColours[number % (kColourCount - 1)]) + '"');
  }
  for (const Curve& curve : known) {
    // Few points are a line or marks as measured; many are a line.
    const bool marks = curve.x.size() > 2 && curve.x.size() < 60;
    plot(curve, marks ? "points pointtype 7 pointsize 0.8 linecolor rgb \"#000000\""
                      : "lines dashtype 2 linecolor rgb \"#000000\"");
  }
  out << '\n';
  out.close();
  if (!out) throw std::runtime_error("cannot write " + script.string());
  synth::run_gnuplot(script);
}

}  // namespace splash::validation
