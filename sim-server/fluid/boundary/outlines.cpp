// SPDX-License-Identifier: MIT
#include "sim-server/fluid/boundary/outlines.hpp"

#include <limits>
#include <stdexcept>

#include "sim-server/scene/mesh/mesh_solid.hpp"
#include "sim-server/scene/shape.hpp"

namespace splash::sim {
namespace {

float as_float(double value) {
  return static_cast<float>(value);
}

void add_mesh(const MeshSolid& solid, BodyShape& shape, std::vector<float>& meshes) {
  const DistanceField& field = solid.field();
  shape.field = static_cast<int>(meshes.size());
  shape.nodes_x = field.nodes[0];
  shape.nodes_y = field.nodes[1];
  shape.nodes_z = field.nodes[2];
  shape.lower_x = as_float(field.lower[0]);
  shape.lower_y = as_float(field.lower[1]);
  shape.lower_z = as_float(field.lower[2]);
  shape.cell = as_float(field.cell);
  meshes.insert(meshes.end(), field.values.begin(), field.values.end());
  shape.vertices = static_cast<int>(meshes.size());
  shape.vertex_count = static_cast<int>(solid.surface.vertices.size());
  for (const Vector3& vertex : solid.surface.vertices) {
    for (const double part : vertex) meshes.push_back(as_float(part));
  }
  if (meshes.size() > static_cast<std::size_t>(std::numeric_limits<int>::max()) / 2) {
    throw std::length_error(
        "the meshes of all bodies together are too large; make their scales smaller, or the "
        "spacing of the fluid larger");
  }
}

}  // namespace

Outlines body_outlines(const std::vector<BodySettings>& bodies) {
  Outlines all;
  for (const BodySettings& body : bodies) {
    const Shape& s = body.shape;
    const Vector3 half = farthest_of(s);
    BodyShape shape = {};
    shape.kind = static_cast<int>(s.kind);
    shape.half_x = as_float(half[0]);
    shape.half_y = as_float(half[1]);
    shape.half_z = as_float(half[2]);
    shape.rocker = as_float(s.rocker);
    shape.flat = as_float(s.flat);
    if (s.kind == ShapeKind::mesh) add_mesh(*s.mesh, shape, all.meshes);
    all.shapes.push_back(shape);
  }
  return all;
}

}  // namespace splash::sim
