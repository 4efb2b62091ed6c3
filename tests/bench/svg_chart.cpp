// SPDX-License-Identifier: MIT
#include "tests/bench/svg_chart.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <fstream>
#include <stdexcept>

namespace splash::bench {
namespace {

constexpr double kLeft = 80.0, kTop = 50.0, kWidth = 640.0, kHeight = 400.0;  ///< of the frame [px]
constexpr std::array<const char*, 4> kColours = {"#1f77b4", "#d62728", "#2ca02c", "#7f7f7f"};

/// Whole decades around all values.
struct Axis {
  int first = 0;
  int last = 1;

  void hold(double value) {
    first = std::min(first, static_cast<int>(std::floor(std::log10(value))));
    last = std::max(last, static_cast<int>(std::ceil(std::log10(value))));
  }
  [[nodiscard]] double share(double value) const {
    return (std::log10(value) - first) / (last - first);
  }
};

/// The smallest that holds nothing.
Axis axis_at(double value) {
  const int decade = static_cast<int>(std::floor(std::log10(value)));
  return {decade, decade + 1};
}

double across(const Axis& axis, double value) {
  return kLeft + kWidth * axis.share(value);
}

double down(const Axis& axis, double value) {
  return kTop + kHeight * (1.0 - axis.share(value));
}

std::string escaped(const std::string& text) {
  std::string safe;
  for (const char c : text) {
    if (c == '<') {
      safe += "&lt;";
    } else if (c == '&') {
      safe += "&amp;";
    } else {
      safe += c;
    }
  }
  return safe;
}

void write_text(std::ostream& out, double x, double y, const char* anchor,
                const std::string& text) {
  out << "<text x=\"" << x << "\" y=\"" << y << "\" text-anchor=\"" << anchor << "\">"
      << escaped(text) << "</text>\n";
}

void write_line(std::ostream& out, double x1, double y1, double x2, double y2) {
  out << "<line x1=\"" << x1 << "\" y1=\"" << y1 << "\" x2=\"" << x2 << "\" y2=\"" << y2
      << "\" stroke=\"#ddd\"/>\n";
}

void write_grid(std::ostream& out, const Axis& x, const Axis& y) {
  for (int k = x.first; k <= x.last; ++k) {
    const double place = across(x, std::pow(10.0, k));
    write_line(out, place, kTop, place, kTop + kHeight);
    write_text(out, place, kTop + kHeight + 18.0, "middle", "1e" + std::to_string(k));
  }
  for (int k = y.first; k <= y.last; ++k) {
    const double place = down(y, std::pow(10.0, k));
    write_line(out, kLeft, place, kLeft + kWidth, place);
    write_text(out, kLeft - 8.0, place + 4.0, "end", "1e" + std::to_string(k));
  }
}

void write_curve(std::ostream& out, const Axis& x, const Axis& y, const SvgCurve& curve,
                 std::size_t number) {
  const char* colour = kColours[number % kColours.size()];
  out << "<polyline fill=\"none\" stroke=\"" << colour << "\" stroke-width=\"2\" points=\"";
  for (const auto& [a, b] : curve.points) out << across(x, a) << ',' << down(y, b) << ' ';
  out << "\"/>\n";
  for (const auto& [a, b] : curve.points) {
    out << "<circle cx=\"" << across(x, a) << "\" cy=\"" << down(y, b) << "\" r=\"3\" fill=\""
        << colour << "\"/>\n";
  }
  const double line = kTop + 20.0 + 18.0 * static_cast<double>(number);
  out << "<g fill=\"" << colour << "\">";
  write_text(out, kLeft + 12.0, line, "start", curve.name);
  out << "</g>\n";
}

}  // namespace

void draw_log_chart(const std::filesystem::path& file, const std::string& title,
                    const std::string& x_label, const std::string& y_label,
                    const std::vector<SvgCurve>& curves) {
  const auto& begin = curves.at(0).points.at(0);
  Axis x = axis_at(begin.first);
  Axis y = axis_at(begin.second);
  for (const SvgCurve& curve : curves) {
    for (const auto& [a, b] : curve.points) {
      x.hold(a);
      y.hold(b);
    }
  }
  std::ofstream out(file);
  out << "<svg xmlns=\"http://www.w3.org/2000/svg\" width=\"" << kLeft + kWidth + 40.0
      << "\" height=\"" << kTop + kHeight + 60.0
      << "\" font-family=\"sans-serif\" font-size=\"13\">\n"
         "<rect width=\"100%\" height=\"100%\" fill=\"white\"/>\n";
  write_grid(out, x, y);
  for (std::size_t k = 0; k < curves.size(); ++k) write_curve(out, x, y, curves[k], k);
  const double middle = kLeft + kWidth / 2.0;
  write_text(out, middle, 24.0, "middle", title);
  write_text(out, middle, kTop + kHeight + 44.0, "middle", x_label);
  write_text(out, kLeft, kTop - 10.0, "middle", y_label);
  out << "</svg>\n";
  if (!out.flush()) throw std::runtime_error("cannot write " + file.string());
}

}  // namespace splash::bench
