// SPDX-License-Identifier: MIT
#include "sim-server/scene/mesh/triangle_mesh.hpp"

#include <cmath>
#include <map>
#include <utility>

#include "sim-server/scene/rotation.hpp"

namespace splash::sim {

std::array<Vector3, 3> corners(const TriangleMesh& mesh, std::size_t triangle) {
  const auto at = [&](std::size_t k) {
    return mesh.vertices[static_cast<std::size_t>(mesh.triangles[triangle][k])];
  };
  return {at(0), at(1), at(2)};
}

Vector3 face_normal(const std::array<Vector3, 3>& corner) {
  const Vector3 n = cross(corner[1] - corner[0], corner[2] - corner[0]);
  return (1.0 / length(n)) * n;
}

double angle_at(const std::array<Vector3, 3>& corner, std::size_t k) {
  const Vector3 one = corner[(k + 1) % 3] - corner[k];
  const Vector3 other = corner[(k + 2) % 3] - corner[k];
  return std::atan2(length(cross(one, other)), dot(one, other));
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
