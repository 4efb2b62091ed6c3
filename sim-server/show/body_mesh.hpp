// SPDX-License-Identifier: MIT
// The surface of a body as triangles, for those who draw it.
#pragma once

#include "sim-server/scene/mesh/triangle_mesh.hpp"

namespace splash::sim {

/// In the body's axes, closed. A mesh's own, else the surface of a cube carried to the shape.
[[nodiscard]] TriangleMesh body_mesh(const Shape& shape);

}  // namespace splash::sim
