// SPDX-License-Identifier: MIT
// Triangle meshes from files: Wavefront OBJ (v and f lines; other polygons are cut into fans) and
// STL, binary or text. Read by ourselves: tinyobjloader reads no STL, and neither it nor assimp
// tells the line of what is wrong, which whoever made the file has to find.
#pragma once

#include <filesystem>
#include <string>
#include <string_view>

#include "sim-server/scene/mesh/mesh_text.hpp"
#include "sim-server/scene/mesh/triangle_mesh.hpp"

namespace splash::sim {

/// By the name's ending, .obj or .stl. Lengths are multiplied by `scale` [m per unit of the file].
/// Throws program::ConfigError with file and line: cannot be read, larger than 16 MB, another
/// format, wrong lines, numbers that are not finite or beyond 100 m, more than kTrianglesMax.
[[nodiscard]] TriangleMesh read_mesh(const std::filesystem::path& path, double scale);

/// The same of a file's bytes; `file` names it, and its ending says which format it is.
[[nodiscard]] TriangleMesh parse_mesh(const std::string& bytes, const std::string& file,
                                      double scale);

// Wavefront OBJ, the part of it that is a surface of polygons: v and f. Texture, normals, groups,
// materials, lines and points are passed over; curved surfaces are refused.

/// Throws program::ConfigError at the line that is wrong.
[[nodiscard]] TriangleMesh parse_obj(MeshText text);

// STL, as text and in binary: triangles by their corners. The normals that it names beside them are
// not used: the order of the corners says which side is outside.

/// Whether the bytes are as long as their header says: 80 bytes, a count, 50 bytes a triangle.
[[nodiscard]] bool is_binary_stl(std::string_view bytes);

/// These throw program::ConfigError at the line, or with the number of the triangle, that is
/// wrong. `scale`: [m per unit of the file].
[[nodiscard]] TriangleMesh parse_binary_stl(std::string_view bytes, const std::string& file,
                                            double scale);
[[nodiscard]] TriangleMesh parse_stl(MeshText text);

}  // namespace splash::sim
