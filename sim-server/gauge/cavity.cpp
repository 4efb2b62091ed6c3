// SPDX-License-Identifier: MIT
#include "sim-server/gauge/cavity.hpp"

#include <algorithm>
#include <array>
#include <cmath>

#include "sim-server/fluid/smoothing.hpp"
#include "sim-server/scene/rotation.hpp"

namespace splash::sim {

namespace {

/// The region in cells, x fastest.
class Cells {
 public:
  Cells(const Vector3& lower, const Vector3& upper, double spacing) : lower_(lower) {
    for (std::size_t i = 0; i < 3; ++i) {
      const double layers = std::max(std::round((upper[i] - lower[i]) / spacing), 1.0);
      count_[i] = static_cast<int>(layers);
      edge_[i] = (upper[i] - lower[i]) / layers;
    }
    colour_.resize(static_cast<std::size_t>(count_[0]) * static_cast<std::size_t>(count_[1]) *
                   static_cast<std::size_t>(count_[2]));
  }

  [[nodiscard]] int count(std::size_t axis) const { return count_[axis]; }
  [[nodiscard]] std::size_t index(int i, int j, int k) const {
    const auto row = static_cast<std::size_t>(k) * static_cast<std::size_t>(count_[1]) +
                     static_cast<std::size_t>(j);
    return row * static_cast<std::size_t>(count_[0]) + static_cast<std::size_t>(i);
  }
  [[nodiscard]] Vector3 middle(int i, int j, int k) const {
    return {lower_[0] + (i + 0.5) * edge_[0], lower_[1] + (j + 0.5) * edge_[1],
            lower_[2] + (k + 0.5) * edge_[2]};
  }
  [[nodiscard]] double volume() const { return edge_[0] * edge_[1] * edge_[2]; }
  [[nodiscard]] std::vector<double>& colour() { return colour_; }

  /// Cells whose middles are within `reach` of `x` along an axis: first, and one past the last.
  [[nodiscard]] std::array<int, 2> range(std::size_t axis, double x, double reach) const {
    const double at = (x - lower_[axis]) / edge_[axis] - 0.5;
    const double by = reach / edge_[axis];
    const double last = count_[axis];
    return {static_cast<int>(std::clamp(std::ceil(at - by), 0.0, last)),
            static_cast<int>(std::clamp(std::floor(at + by) + 1.0, 0.0, last))};
  }

 private:
  Vector3 lower_;
  Vector3 edge_ = {};
  std::array<int, 3> count_ = {};
  std::vector<double> colour_;
};

void paint(Cells& cells, const Vector3& point, double volume, double support) {
  const auto [i0, i1] = cells.range(0, point[0], support);
  const auto [j0, j1] = cells.range(1, point[1], support);
  const auto [k0, k1] = cells.range(2, point[2], support);
  for (int k = k0; k < k1; ++k) {
    for (int j = j0; j < j1; ++j) {
      for (int i = i0; i < i1; ++i) {
        const double r = length(cells.middle(i, j, k) - point);
        cells.colour()[cells.index(i, j, k)] += volume * kernel_value(r, support);
      }
    }
  }
}

std::vector<char> air_of(Cells& cells, const std::function<bool(const Vector3&)>& solid) {
  std::vector<char> air(cells.colour().size(), 0);
  for (int k = 0; k < cells.count(2); ++k) {
    for (int j = 0; j < cells.count(1); ++j) {
      for (int i = 0; i < cells.count(0); ++i) {
        const std::size_t c = cells.index(i, j, k);
        air[c] = cells.colour()[c] < 0.5 && !solid(cells.middle(i, j, k)) ? 1 : 0;
      }
    }
  }
  return air;
}

/// Takes the air joined to a cell away; how many cells it was.
int drain(const Cells& cells, std::vector<char>& air, int i, int j, int k) {
  std::vector<std::array<int, 3>> open;
  const auto visit = [&](int a, int b, int c) {
    if (a < 0 || b < 0 || c < 0 || a >= cells.count(0) || b >= cells.count(1) ||
        c >= cells.count(2)) {
      return;
    }
    char& cell = air[cells.index(a, b, c)];
    if (cell == 0) return;
    cell = 0;
    open.push_back({a, b, c});
  };
  visit(i, j, k);
  int drained = 0;
  while (!open.empty()) {
    const auto [a, b, c] = open.back();
    open.pop_back();
    ++drained;
    visit(a - 1, b, c);
    visit(a + 1, b, c);
    visit(a, b - 1, c);
    visit(a, b + 1, c);
    visit(a, b, c - 1);
    visit(a, b, c + 1);
  }
  return drained;
}

}  // namespace

Cavity find_cavity(std::span<const Vector3> points, const WaterState& water, const Vector3& lower,
                   const Vector3& upper, const std::function<bool(const Vector3&)>& solid) {
  Cells cells(lower, upper, water.spacing);
  for (const Vector3& point : points) paint(cells, point, water.volume(), water.support);
  std::vector<char> air = air_of(cells, solid);
  Cavity cavity;
  const int top = cells.count(2) - 1;
  for (int j = 0; j < cells.count(1); ++j) {
    for (int i = 0; i < cells.count(0); ++i) cavity.open += drain(cells, air, i, j, top);
  }
  for (int k = 0; k < top; ++k) {
    for (int j = 0; j < cells.count(1); ++j) {
      for (int i = 0; i < cells.count(0); ++i) {
        const double pocket = drain(cells, air, i, j, k);
        cavity.enclosed += pocket;
        cavity.pocket = std::max(cavity.pocket, pocket);
      }
    }
  }
  cavity.open *= cells.volume();
  cavity.enclosed *= cells.volume();
  cavity.pocket *= cells.volume();
  return cavity;
}

}  // namespace splash::sim
