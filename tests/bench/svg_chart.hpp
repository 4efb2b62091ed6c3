// SPDX-License-Identifier: MIT
// A picture of curves over two logarithmic axes, as SVG: for machines that have nothing to draw
// with.
#pragma once

#include <filesystem>
#include <string>
#include <utility>
#include <vector>

namespace splash::bench {

struct SvgCurve {
  std::string name;
  std::vector<std::pair<double, double>> points;  ///< all above 0
};

/// Throws std::runtime_error when the file cannot be written.
void draw_log_chart(const std::filesystem::path& file, const std::string& title,
                    const std::string& x_label, const std::string& y_label,
                    const std::vector<SvgCurve>& curves);

}  // namespace splash::bench
