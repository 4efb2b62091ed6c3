// SPDX-License-Identifier: MIT
#include "sim-server/gauge/sensors.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "sim-server/fluid/air/air_cells.hpp"
#include "sim-server/fluid/params/smoothing.hpp"
#include "sim-server/scene/rotation.hpp"

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

double front_position(const WaterState& water, std::size_t axis, double sign, double width) {
  std::vector<double> ahead;  // sign * coordinate, the farthest first
  ahead.reserve(water.position.size());
  for (const Vector3& x : water.position) ahead.push_back(sign * x[axis]);
  std::sort(ahead.begin(), ahead.end(), std::greater<>());
  const auto wanted =
      static_cast<std::size_t>(std::max(std::ceil(0.5 * width / water.spacing), 1.0));
  for (std::size_t first = 0; first + wanted <= ahead.size(); ++first) {
    if (ahead[first] - ahead[first + wanted - 1] > water.spacing) continue;
    return sign * (ahead[first] + water.spacing / 2.0);
  }
  return std::numeric_limits<double>::quiet_NaN();
}

namespace {

/// Colour below which a point counts as dry. On a flat surface it is 0.5, at a wall as much.
constexpr double kDry = 0.1;

}  // namespace

double pressure_at(const WaterState& water, const Vector3& place) {
  double weight = 0.0;
  double sum = 0.0;
  for (std::size_t j = 0; j < water.position.size(); ++j) {
    const Vector3 from = place - water.position[j];
    const double r2 = dot(from, from);
    if (r2 >= water.support * water.support) continue;
    const double w = kernel_value(std::sqrt(r2), water.support);
    weight += w;
    sum +=
        w * (water.pressure[j] + water.rest_density * dot(water.field_at(water.position[j]), from));
  }
  if (water.volume() * weight < kDry) return 0.0;
  return std::max(sum / weight, 0.0);
}

FlowAt flow_at(const WaterState& water, const Vector3& place) {
  double weight = 0.0;
  Vector3 sum = {0.0, 0.0, 0.0};
  for (std::size_t j = 0; j < water.position.size(); ++j) {
    const double r = length(place - water.position[j]);
    if (r >= water.support) continue;
    const double w = kernel_value(r, water.support);
    weight += w;
    sum = sum + w * water.velocity[j];
  }
  FlowAt flow;
  flow.colour = water.volume() * weight;
  if (flow.colour >= kDry) flow.velocity = (1.0 / weight) * sum;
  return flow;
}

Cavity find_cavity(std::span<const Vector3> points, const WaterState& water, const Vector3& lower,
                   const Vector3& upper, const std::function<bool(const Vector3&)>& solid) {
  AirCells cells(lower, upper, water.spacing, water.support);
  for (const Vector3& point : points) cells.add(point, water.volume());
  cells.fill(solid);
  Cavity cavity;
  cavity.open = cells.open();
  for (const double pocket : cells.pockets()) {
    cavity.enclosed += pocket;
    cavity.pocket = std::max(cavity.pocket, pocket);
  }
  return cavity;
}

}  // namespace splash::sim
