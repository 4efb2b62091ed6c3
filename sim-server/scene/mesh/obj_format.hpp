// SPDX-License-Identifier: MIT
// Wavefront OBJ, the part of it that is a surface of polygons: v and f. Texture, normals, groups,
// materials, lines and points are passed over; curved surfaces are refused.
#pragma once

#include "sim-server/scene/mesh/mesh_text.hpp"
#include "sim-server/scene/mesh/triangle_mesh.hpp"

namespace splash::sim {

/// Throws program::ConfigError at the line that is wrong.
[[nodiscard]] TriangleMesh parse_obj(MeshText text);

}  // namespace splash::sim
