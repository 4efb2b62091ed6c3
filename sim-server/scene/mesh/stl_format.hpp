// SPDX-License-Identifier: MIT
// STL, as text and in binary: triangles by their corners. The normals that it names beside them are
// not used: the order of the corners says which side is outside.
#pragma once

#include <string>
#include <string_view>

#include "sim-server/scene/mesh/mesh_text.hpp"
#include "sim-server/scene/mesh/triangle_mesh.hpp"

namespace splash::sim {

/// Whether the bytes are as long as their header says: 80 bytes, a count, 50 bytes a triangle.
[[nodiscard]] bool is_binary_stl(std::string_view bytes);

/// These throw program::ConfigError at the line, or with the number of the triangle, that is
/// wrong. `scale`: [m per unit of the file].
[[nodiscard]] TriangleMesh parse_binary_stl(std::string_view bytes, const std::string& file,
                                            double scale);
[[nodiscard]] TriangleMesh parse_stl(MeshText text);

}  // namespace splash::sim
