// SPDX-License-Identifier: MIT
#include "sim-server/scene/shape.hpp"

#include <algorithm>
#include <cmath>

namespace splash::sim {

namespace {

double box_distance(const Vector3& half, const Vector3& point) {
  Vector3 over;
  for (std::size_t i = 0; i < 3; ++i) over[i] = std::abs(point[i]) - half[i];
  const double inside = std::min(0.0, std::max({over[0], over[1], over[2]}));
  for (double& part : over) part = std::max(part, 0.0);
  return std::hypot(over[0], over[1], over[2]) + inside;
}

double cylinder_distance(double radius, double half_length, const Vector3& point) {
  const double side = std::hypot(point[0], point[1]) - radius;
  const double cap = std::abs(point[2]) - half_length;
  return std::hypot(std::max(side, 0.0), std::max(cap, 0.0)) + std::min(0.0, std::max(side, cap));
}

}  // namespace

double rocker_rise(const Shape& shape, double x) {
  if (shape.kind != ShapeKind::box || shape.rocker <= 0.0) return 0.0;
  const double share = std::min(2.0 * std::abs(x) / shape.size[0], 1.0);
  const double curved = std::max(share - shape.flat, 0.0) / (1.0 - shape.flat);
  return shape.rocker * curved * curved;
}

double distance_to(const Shape& shape, const Vector3& point) {
  const Vector3 half = {0.5 * shape.size[0], 0.5 * shape.size[1], 0.5 * shape.size[2]};
  switch (shape.kind) {
    case ShapeKind::sphere:
      return std::hypot(point[0], point[1], point[2]) - half[0];
    case ShapeKind::cylinder:
      return cylinder_distance(half[0], half[2], point);
    case ShapeKind::box:
      break;
  }
  return box_distance(half, point);
}

}  // namespace splash::sim
