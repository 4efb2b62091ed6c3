// SPDX-License-Identifier: MIT
#include "sim-server/scene/mesh/soundness.hpp"

#include <algorithm>
#include <map>
#include <utility>

#include "sim-server/scene/mesh/mesh_mass.hpp"
#include "sim-server/scene/rotation.hpp"

namespace splash::sim {
namespace {

/// Height over the longest side, in that side, below which a triangle is none [1].
constexpr double kFlattest = 1.0e-6;
/// What is shorter than this along each axis was meant to be larger [m].
constexpr double kSmallest = 1.0e-4;
/// Volume, in that of the box around the mesh, below which there is none [1].
constexpr double kEmptiest = 1.0e-6;

using Edge = std::pair<int, int>;

void check_areas(const TriangleMesh& mesh) {
  for (std::size_t t = 0; t < mesh.triangles.size(); ++t) {
    const auto [a, b, c] = corners(mesh, t);
    const double longest = std::max({length(b - a), length(c - b), length(a - c)});
    if (length(cross(b - a, c - a)) > kFlattest * longest * longest) continue;
    throw triangle_error(mesh, t,
                         "has no area: its corners lie on one line; remove it (Blender: Merge by "
                         "Distance, Degenerate Dissolve)");
  }
}

Edge edge_of(const TriangleMesh& mesh, std::size_t triangle, std::size_t side) {
  const auto& corner = mesh.triangles[triangle];
  return {corner[side], corner[(side + 1) % 3]};
}

void check_edges(const TriangleMesh& mesh) {
  std::map<Edge, std::size_t> owner;
  for (std::size_t t = 0; t < mesh.triangles.size(); ++t) {
    for (std::size_t side = 0; side < 3; ++side) {
      const auto [other, is_new] = owner.emplace(edge_of(mesh, t, side), t);
      if (is_new) continue;
      throw triangle_error(
          mesh, t,
          "and triangle " + std::to_string(other->second + 1) +
              " run along their common edge in the same direction: one of them is inside out, or "
              "more than two meet there (Blender: Recalculate Outside, Select Non Manifold)");
    }
  }
  for (std::size_t t = 0; t < mesh.triangles.size(); ++t) {
    for (std::size_t side = 0; side < 3; ++side) {
      const Edge edge = edge_of(mesh, t, side);
      if (owner.contains({edge.second, edge.first})) continue;
      throw triangle_error(mesh, t,
                           "has an edge without a neighbour: the surface is not closed; fill the "
                           "hole, or join vertices that only nearly meet (Blender: Merge by "
                           "Distance, Fill Holes)");
    }
  }
}

void check_volume(const TriangleMesh& mesh) {
  Vector3 lower = mesh.vertices.front();
  Vector3 upper = lower;
  for (const Vector3& x : mesh.vertices) grow_box(x, lower, upper);
  const Vector3 size = upper - lower;
  const program::Place place{.file = mesh.file};
  if (std::max({size[0], size[1], size[2]}) < kSmallest) {
    throw program::ConfigError(place,
                               "is smaller than 0.1 mm along each axis; give it a scale: how "
                               "many metres one unit of the file is");
  }
  const double volume = signed_volume(mesh);
  const double least = kEmptiest * size[0] * size[1] * size[2];
  if (volume > least) return;
  if (volume < -least) {
    throw program::ConfigError(place,
                               "the surface is inside out: its triangles run clockwise, seen from "
                               "outside; turn them over (Blender: Recalculate Outside)");
  }
  throw program::ConfigError(place, "the surface encloses no volume");
}

}  // namespace

void check_soundness(const TriangleMesh& mesh) {
  check_areas(mesh);
  check_edges(mesh);
  check_volume(mesh);
}

}  // namespace splash::sim
