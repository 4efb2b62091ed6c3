// SPDX-License-Identifier: MIT
// Triangle meshes from files: Wavefront OBJ (v and f lines; other polygons are cut into fans) and
// STL, binary or text. Read by ourselves: tinyobjloader reads no STL, and neither it nor assimp
// tells the line of what is wrong, which whoever made the file has to find.
#pragma once

#include <filesystem>
#include <string>

#include "sim-server/scene/mesh/triangle_mesh.hpp"

namespace splash::sim {

/// By the name's ending, .obj or .stl. Lengths are multiplied by `scale` [m per unit of the file].
/// Throws program::ConfigError with file and line: cannot be read, larger than 16 MB, another
/// format, wrong lines, numbers that are not finite or beyond 100 m, more than kTrianglesMax.
[[nodiscard]] TriangleMesh read_mesh(const std::filesystem::path& path, double scale);

/// The same of a file's bytes; `file` names it, and its ending says which format it is.
[[nodiscard]] TriangleMesh parse_mesh(const std::string& bytes, const std::string& file,
                                      double scale);

}  // namespace splash::sim
