// SPDX-License-Identifier: MIT
// A surface made of triangles, and where each of them stands in its file.
#pragma once

#include <array>
#include <cstddef>
#include <string>
#include <vector>

#include "program/config.hpp"
#include "sim-server/scene/scene.hpp"

namespace splash::sim {

/// More make a scene slow to load: 20,000 take about a second.
inline constexpr std::size_t kTrianglesMax = 20000;

[[nodiscard]] std::string too_many_triangles();

struct TriangleMesh {
  std::string file;
  std::vector<Vector3> vertices;              ///< [m]
  std::vector<std::array<int, 3>> triangles;  ///< counter-clockwise, seen from outside
  std::vector<int> lines;                     ///< of the file, of each triangle; binary files: 1
};

/// The three corners of a triangle [m].
[[nodiscard]] std::array<Vector3, 3> corners(const TriangleMesh& mesh, std::size_t triangle);

/// Outwards, of unit length.
[[nodiscard]] Vector3 face_normal(const std::array<Vector3, 3>& corner);
/// The angle of the triangle at its corner k [rad].
[[nodiscard]] double angle_at(const std::array<Vector3, 3>& corner, std::size_t k);
/// What is wrong with one triangle, told with its file, its line and its number from 1.
[[nodiscard]] program::ConfigError triangle_error(const TriangleMesh& mesh, std::size_t triangle,
                                                  const std::string& reason);

/// Vertices at the very same place become one: STL files name each corner anew, and OBJ files
/// where a texture has a seam. Those of no triangle go.
void join_equal_vertices(TriangleMesh& mesh);

}  // namespace splash::sim
