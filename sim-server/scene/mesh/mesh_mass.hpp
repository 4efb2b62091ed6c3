// SPDX-License-Identifier: MIT
// Volume, centre and moments of inertia of the solid within a closed surface of triangles: exact
// integrals over the tetrahedra between each triangle and one point (the polynomials of Mirtich
// 1996, "Fast and Accurate Computation of Polyhedral Mass Properties", in the form of Eberly 2002).
//   V = sum det / 6,   V c = sum det / 24 (a + b + c),
//   integral of x x^T = sum det / 120 (a a^T + b b^T + c c^T + (a + b + c) (a + b + c)^T)
// with det = a . (b x c) of a triangle's corners.
#pragma once

#include "sim-server/scene/mesh/triangle_mesh.hpp"

namespace splash::sim {

struct MeshMass {
  double volume = 0.0;                     ///< [m3]
  Vector3 centre = {0.0, 0.0, 0.0};        ///< of mass, of a body that is the same everywhere [m]
  Vector3 inertia = {0.0, 0.0, 0.0};       ///< principal moments about it, per mass [m2]
  Quaternion axes = {0.0, 0.0, 0.0, 1.0};  ///< turns the mesh's axes to the principal ones
};

/// Negative where the surface is inside out [m3].
[[nodiscard]] double signed_volume(const TriangleMesh& mesh);

/// Of a mesh that encloses a volume.
[[nodiscard]] MeshMass mesh_mass(const TriangleMesh& mesh);

}  // namespace splash::sim
