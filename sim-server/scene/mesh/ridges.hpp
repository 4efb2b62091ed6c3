// SPDX-License-Identifier: MIT
// Where a mesh is pointed or sharp: what meets the water first, and would be missed by points that
// only lie on its faces.
#pragma once

#include <vector>

#include "sim-server/scene/mesh/triangle_mesh.hpp"

namespace splash::sim {

struct Ridges {
  std::vector<Vector3> edges;  ///< points along them, without their ends [m]
  std::vector<Vector3> tips;   ///< their ends, and tips of cones [m]
};

/// Edges are those at which the surface turns outwards by more than 30 degrees, with points no
/// farther apart than `step` [m]; tips are vertices at which they end, or around which more than 30
/// degrees of the full turn are missing. Of a sound mesh.
[[nodiscard]] Ridges find_ridges(const TriangleMesh& mesh, double step);

}  // namespace splash::sim
