// SPDX-License-Identifier: MIT
// Meshes of forms that are known in closed form.
#pragma once

#include "sim-server/scene/mesh/triangle_mesh.hpp"

namespace splash::sim {

/// Twelve triangles, about the origin. `size`: edges [m].
[[nodiscard]] TriangleMesh box_mesh(const Vector3& size);

/// A box about the origin without its lid: floor and sides `wall` thick [m].
[[nodiscard]] TriangleMesh tray_mesh(const Vector3& size, double wall);

/// An icosahedron about the origin, each triangle cut into four `levels` times, its vertices on the
/// sphere: 20 * 4^levels triangles.
[[nodiscard]] TriangleMesh sphere_mesh(double radius, int levels);

/// Turned, then moved.
[[nodiscard]] TriangleMesh placed(TriangleMesh mesh, const Quaternion& turn, const Vector3& way);

/// As an OBJ file says it.
[[nodiscard]] std::string obj_text(const TriangleMesh& mesh);
/// As a binary STL file says it.
[[nodiscard]] std::string stl_bytes(const TriangleMesh& mesh);

}  // namespace splash::sim
