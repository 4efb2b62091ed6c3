// SPDX-License-Identifier: MIT
#include "sim-server/scene/shape.hpp"

#include <algorithm>
#include <cmath>
#include <iterator>
#include <numbers>
#include <utility>
#include <vector>

#include "program/text.hpp"
#include "sim-server/scene/mesh/mesh_solid.hpp"
#include "sim-server/scene/rotation.hpp"

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

#define SPLASH_NAME(name, in_kernels, sizes) #name,
#define SPLASH_SIZES(name, in_kernels, sizes) sizes,
constexpr const char* kNames[] = {SPLASH_BODY_FORMS(SPLASH_NAME)};
constexpr const char* kSizes[] = {SPLASH_BODY_FORMS(SPLASH_SIZES)};
#undef SPLASH_NAME
#undef SPLASH_SIZES

std::string wrong_diameters(const Shape& shape) {
  if (shape.size[0] == shape.size[1]) return {};
  return program::format("x and y are diameters and must be equal (got %g and %g)", shape.size[0],
                         shape.size[1]);
}

}  // namespace

const char* name_of(ShapeKind kind) {
  return kNames[static_cast<std::size_t>(kind)];
}

std::vector<std::string> shape_names() {
  return {std::begin(kNames), std::begin(kNames) + static_cast<int>(ShapeKind::mesh)};
}

ShapeKind shape_kind(const std::string& name) {
  const std::vector<std::string> names = shape_names();
  return static_cast<ShapeKind>(std::find(names.begin(), names.end(), name) - names.begin());
}

std::string size_meanings() {
  std::string text;
  for (const std::string& name : shape_names()) {
    text += (text.empty() ? "" : "; ") + name + ": " +
            kSizes[static_cast<std::size_t>(shape_kind(name))];
  }
  return text;
}

std::string wrong_size(const Shape& shape) {
  switch (shape.kind) {
    case ShapeKind::sphere:
      if (shape.size[0] != shape.size[1]) return wrong_diameters(shape);
      return shape.size[0] == shape.size[2] ? "" : "a sphere's three diameters must be equal";
    case ShapeKind::cylinder:
      return wrong_diameters(shape);
    case ShapeKind::box:
    case ShapeKind::mesh:
      break;
  }
  return {};
}

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
    case ShapeKind::mesh:
      return shape.mesh->field().at(point);
    case ShapeKind::box:
      break;
  }
  return box_distance(half, point);
}

bool is_inside(const Shape& shape, const Vector3& place) {
  const double rx = shape.size[0] / 2.0;
  const double ry = shape.size[1] / 2.0;
  const double rz = shape.size[2] / 2.0;
  switch (shape.kind) {
    case ShapeKind::sphere:
      return std::hypot(place[0] / rx, place[1] / ry, place[2] / rz) <= 1.0;
    case ShapeKind::cylinder:
      return std::hypot(place[0] / rx, place[1] / ry) <= 1.0 && std::abs(place[2]) <= rz;
    case ShapeKind::mesh:
      return shape.mesh->field().at(place) <= 0.0;
    case ShapeKind::box:
      break;
  }
  return std::abs(place[0]) <= rx && std::abs(place[1]) <= ry && place[2] <= rz &&
         place[2] >= -rz + rocker_rise(shape, place[0]);
}

Vector3 from_cube(const Shape& shape, const Vector3& cube) {
  Vector3 place = cube;
  switch (shape.kind) {
    case ShapeKind::sphere: {
      const double size = length(cube);
      place = size > 0.0 ? (1.0 / size) * cube : Vector3{0.0, 0.0, 1.0};
      break;
    }
    case ShapeKind::cylinder: {
      const double around = std::hypot(cube[0], cube[1]);
      const double reach = std::max(std::abs(cube[0]), std::abs(cube[1]));
      const double scale = around > 0.0 ? reach / around : 1.0;
      place = {scale * cube[0], scale * cube[1], cube[2]};
      break;
    }
    case ShapeKind::box:
    case ShapeKind::mesh:
      break;
  }
  for (std::size_t axis = 0; axis < 3; ++axis) place[axis] *= shape.size[axis] / 2.0;
  // A curved sole squeezes what is above it.
  place[2] += rocker_rise(shape, place[0]) * (1.0 - cube[2]) / 2.0;
  return place;
}

namespace {

/// Along each axis in which it is in the outermost layer it moves to that face. So edges and
/// corners, which meet the water first, are where they are.
Vector3 carried_to_face(const Shape& shape, const LatticePlace& point) {
  Vector3 skin = point.place;
  for (std::size_t axis = 0; axis < 3; ++axis) {
    if (point.side[axis] == 0) continue;
    skin[axis] = point.side[axis] * shape.size[axis] / 2.0;
  }
  if (point.side[2] < 0) skin[2] += rocker_rise(shape, skin[0]);
  return skin;
}

}  // namespace

Vector3 carried_to_skin(const Shape& shape, const LatticePlace& point) {
  const Vector3& place = point.place;
  const double rx = shape.size[0] / 2.0;
  const double ry = shape.size[1] / 2.0;
  const double rz = shape.size[2] / 2.0;
  const double across = std::hypot(place[0] / rx, place[1] / ry);
  switch (shape.kind) {
    case ShapeKind::mesh:
      return shape.mesh->distance.nearest(place).place;
    case ShapeKind::box:
      return carried_to_face(shape, point);
    case ShapeKind::cylinder: {
      const bool at_rim = (1.0 - across) * rx < point.spacing;
      const double scale = at_rim && across > 0.0 ? 1.0 / across : 1.0;
      return {scale * place[0], scale * place[1], carried_to_face(shape, point)[2]};
    }
    case ShapeKind::sphere:
      break;
  }
  const double radius = std::hypot(across, place[2] / rz);
  if (radius <= 0.0) return {0.0, 0.0, -rz};
  return {place[0] / radius, place[1] / radius, place[2] / radius};
}

bool has_edges(const Shape& shape) {
  switch (shape.kind) {
    case ShapeKind::box:
    case ShapeKind::cylinder:
    case ShapeKind::mesh:
      return true;
    case ShapeKind::sphere:
      break;
  }
  return false;
}

double volume_of(const Shape& shape) {
  const double box = shape.size[0] * shape.size[1] * shape.size[2];
  switch (shape.kind) {
    case ShapeKind::sphere:
      return box * std::numbers::pi / 6.0;
    case ShapeKind::cylinder:
      return box * std::numbers::pi / 4.0;
    case ShapeKind::mesh:
      return shape.mesh->mass.volume;
    case ShapeKind::box:
      break;
  }
  // The parabola of the sole takes a third of the rocker on average where it curves.
  return box - shape.size[0] * shape.size[1] * shape.rocker * (1.0 - shape.flat) / 3.0;
}

Vector3 inertia_of(const Shape& shape, double mass) {
  const auto [a, b, c] = shape.size;
  switch (shape.kind) {
    case ShapeKind::sphere: {
      const double round = mass * a * a / 10.0;
      return {round, round, round};
    }
    case ShapeKind::cylinder: {
      const double across = mass * (0.75 * a * a + c * c) / 12.0;
      return {across, across, mass * a * a / 8.0};
    }
    case ShapeKind::mesh: {
      const Vector3& part = shape.mesh->mass.inertia;
      return {mass * part[0], mass * part[1], mass * part[2]};
    }
    case ShapeKind::box:
      break;
  }
  return {mass * (b * b + c * c) / 12.0, mass * (a * a + c * c) / 12.0,
          mass * (a * a + b * b) / 12.0};
}

Quaternion principal_axes(const Shape& shape) {
  return shape.kind == ShapeKind::mesh ? shape.mesh->mass.axes : Quaternion{0.0, 0.0, 0.0, 1.0};
}

namespace {

Vector3 outermost_of(const std::vector<Vector3>& points, const Vector3& direction) {
  return *std::max_element(points.begin(), points.end(), [&](const Vector3& a, const Vector3& b) {
    return dot(a, direction) < dot(b, direction);
  });
}

/// Corners of a box; where its sole curves, of sixty slices of it.
std::vector<Vector3> box_corners(const Shape& shape) {
  const int slices = shape.rocker > 0.0 ? 60 : 1;
  std::vector<Vector3> corners;
  for (int i = 0; i <= slices; ++i) {
    const double x = shape.size[0] * (static_cast<double>(i) / slices - 0.5);
    const double low = rocker_rise(shape, x) - 0.5 * shape.size[2];
    for (const double y : {-0.5 * shape.size[1], 0.5 * shape.size[1]}) {
      corners.push_back({x, y, low});
      corners.push_back({x, y, 0.5 * shape.size[2]});
    }
  }
  return corners;
}

}  // namespace

Vector3 outermost(const Shape& shape, const Vector3& direction) {
  const double across = std::hypot(direction[0], direction[1]);
  const double radius = 0.5 * shape.size[0];
  switch (shape.kind) {
    case ShapeKind::sphere:
      return (radius / std::max(length(direction), 1.0e-12)) * direction;
    case ShapeKind::cylinder: {
      const double share = radius / std::max(across, 1.0e-12);
      return {share * direction[0], share * direction[1],
              std::copysign(0.5 * shape.size[2], direction[2])};
    }
    case ShapeKind::mesh:
      return outermost_of(shape.mesh->surface.vertices, direction);
    case ShapeKind::box:
      break;
  }
  return outermost_of(box_corners(shape), direction);
}

Vector3 farthest_of(const Shape& shape) {
  if (shape.kind != ShapeKind::mesh)
    return {shape.size[0] / 2.0, shape.size[1] / 2.0, shape.size[2] / 2.0};
  Vector3 reach = {};
  for (std::size_t axis = 0; axis < 3; ++axis) {
    reach[axis] = std::max(-shape.mesh->lower[axis], shape.mesh->upper[axis]);
  }
  return reach;
}

Shape mesh_shape(std::shared_ptr<const MeshSolid> solid) {
  Shape shape;
  shape.kind = ShapeKind::mesh;
  for (std::size_t axis = 0; axis < 3; ++axis) {
    shape.size[axis] = solid->upper[axis] - solid->lower[axis];
  }
  shape.mesh = std::move(solid);
  return shape;
}

}  // namespace splash::sim
