// SPDX-License-Identifier: MIT
#include "sim-server/show/body_mesh.hpp"

#include <algorithm>

#include "sim-server/scene/mesh/mesh_solid.hpp"
#include "sim-server/scene/rotation.hpp"
#include "sim-server/scene/shape.hpp"

namespace splash::sim {
namespace {

/// As near to the surface are the middles of quadrilaterals [part of the largest size].
constexpr double kNear = 0.005;
/// Quadrilaterals along an edge of the cube, at most.
constexpr int kMost = 16;

struct Carried {
  TriangleMesh mesh;
  double off = 0.0;  ///< farthest of a quadrilateral's middle from that of its part of the cube [m]
};

void add_face(const Shape& shape, int along, std::size_t axis, double side, Carried& all) {
  const auto at = [&](double i, double k) {
    Vector3 cube;
    cube[axis] = side;
    cube[(axis + 1) % 3] = side * (2.0 * i / along - 1.0);
    cube[(axis + 2) % 3] = 2.0 * k / along - 1.0;
    return from_cube(shape, cube);
  };
  for (int i = 0; i < along; ++i) {
    for (int k = 0; k < along; ++k) {
      const auto first = static_cast<int>(all.mesh.vertices.size());
      all.mesh.vertices.insert(all.mesh.vertices.end(),
                               {at(i, k), at(i + 1, k), at(i + 1, k + 1), at(i, k + 1)});
      all.mesh.triangles.push_back({first, first + 1, first + 2});
      all.mesh.triangles.push_back({first, first + 2, first + 3});
      Vector3 middle = {0.0, 0.0, 0.0};
      for (auto corner = all.mesh.vertices.end() - 4; corner != all.mesh.vertices.end(); ++corner) {
        middle = middle + 0.25 * *corner;
      }
      all.off = std::max(all.off, length(at(i + 0.5, k + 0.5) - middle));
    }
  }
}

Carried carried_cube(const Shape& shape, int along) {
  Carried all;
  for (std::size_t axis = 0; axis < 3; ++axis) {
    for (const double side : {-1.0, 1.0}) add_face(shape, along, axis, side, all);
  }
  join_equal_vertices(all.mesh);
  return all;
}

}  // namespace

TriangleMesh body_mesh(const Shape& shape) {
  if (shape.kind == ShapeKind::mesh) return shape.mesh->surface;
  const double near = kNear * std::max({shape.size[0], shape.size[1], shape.size[2]});
  int along = 1;
  Carried carried = carried_cube(shape, along);
  while (carried.off > near && along < kMost) carried = carried_cube(shape, along *= 2);
  return carried.mesh;
}

}  // namespace splash::sim
