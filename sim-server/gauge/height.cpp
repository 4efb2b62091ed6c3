// SPDX-License-Identifier: MIT
#include "sim-server/gauge/height.hpp"

#include <algorithm>
#include <cmath>

#include "sim-server/fluid/params/smoothing.hpp"

namespace splash::sim {

namespace {

/// Steps per particle spacing; the crossing between two is found by a straight line.
constexpr double kSteps = 8.0;
constexpr double kHalf = 0.5;

/// The points that the line's colour depends on, and how far up they reach.
struct Column {
  std::vector<Vector3> points;
  double top = 0.0;  ///< [m]
};

Column gather(std::span<const Vector3> points, double support, double x, double y, double floor) {
  Column column = {near_line(points, x, y, support), floor};
  for (const Vector3& p : column.points) column.top = std::max(column.top, p[2] + support);
  return column;
}

double colour(const Column& column, const WaterState& water, double x, double y, double z) {
  double sum = 0.0;
  for (const Vector3& p : column.points) {
    sum += kernel_value(std::hypot(p[0] - x, p[1] - y, p[2] - z), water.support);
  }
  return water.volume() * sum;
}

}  // namespace

std::vector<Vector3> near_line(std::span<const Vector3> points, double x, double y, double reach) {
  std::vector<Vector3> near;
  for (const Vector3& p : points) {
    if (std::hypot(p[0] - x, p[1] - y) < reach) near.push_back(p);
  }
  return near;
}

Height water_height(std::span<const Vector3> points, const WaterState& water, double x, double y,
                    double floor) {
  const Column column = gather(points, water.support, x, y, floor);
  const int steps = static_cast<int>(std::ceil((column.top - floor) * kSteps / water.spacing));
  Height height;
  double z = floor;
  double c = colour(column, water, x, y, z);
  for (int k = 1; k <= steps; ++k) {
    const double next_z = floor + k * (column.top - floor) / steps;
    const double next = colour(column, water, x, y, next_z);
    if (c >= kHalf && next >= kHalf) {
      height.wetted += next_z - z;
      height.top = next_z - floor;
    } else if ((c >= kHalf) != (next >= kHalf)) {
      const double crossing = z + (next_z - z) * (kHalf - c) / (next - c);
      height.wetted += c >= kHalf ? crossing - z : next_z - crossing;
      height.top = (c >= kHalf ? crossing : next_z) - floor;
    }
    z = next_z;
    c = next;
  }
  return height;
}

}  // namespace splash::sim
