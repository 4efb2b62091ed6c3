// SPDX-License-Identifier: MIT
#include "sim-server/scene/mesh/triangle_mesh.hpp"

#include <map>
#include <utility>

namespace splash::sim {

std::array<Vector3, 3> corners(const TriangleMesh& mesh, std::size_t triangle) {
  const auto at = [&](std::size_t k) {
    return mesh.vertices[static_cast<std::size_t>(mesh.triangles[triangle][k])];
  };
  return {at(0), at(1), at(2)};
}

program::ConfigError triangle_error(const TriangleMesh& mesh, std::size_t triangle,
                                    const std::string& reason) {
  return {program::Place{.file = mesh.file, .line = mesh.lines[triangle]},
          "triangle " + std::to_string(triangle + 1) + " " + reason};
}

std::string too_many_triangles() {
  return "more than " + std::to_string(kTrianglesMax) +
         " triangles; simplify the surface (Blender: Decimate)";
}

void join_equal_vertices(TriangleMesh& mesh) {
  std::map<Vector3, int> numbers;
  std::vector<Vector3> kept;
  for (auto& triangle : mesh.triangles) {
    for (int& corner : triangle) {
      const Vector3& place = mesh.vertices[static_cast<std::size_t>(corner)];
      const auto [found, is_new] = numbers.emplace(place, static_cast<int>(kept.size()));
      if (is_new) kept.push_back(place);
      corner = found->second;
    }
  }
  mesh.vertices = std::move(kept);
}

}  // namespace splash::sim
