// SPDX-License-Identifier: MIT
// Whether a mesh is the surface of a solid.
#pragma once

#include "sim-server/scene/mesh/triangle_mesh.hpp"

namespace splash::sim {

/// Throws program::ConfigError with the first triangle that is wrong and what to do, unless
/// - every triangle has an area: no side so long that the height over it is below 1e-6 of it;
/// - the surface is closed, and its triangles all run the same way round: each edge belongs to two
///   triangles, which go along it in opposite directions;
/// - it is larger than a tenth of a millimetre;
/// - it encloses a volume, on the side from which its triangles run clockwise.
/// Surfaces that pass through themselves or each other are not found.
void check_soundness(const TriangleMesh& mesh);

}  // namespace splash::sim
