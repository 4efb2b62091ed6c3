// SPDX-License-Identifier: MIT
// A solid within a triangle mesh, with all that is asked of it while water flows around it.
#pragma once

#include <memory>
#include <mutex>
#include <vector>

#include "sim-server/scene/mesh/distance_field.hpp"
#include "sim-server/scene/mesh/mesh_distance.hpp"
#include "sim-server/scene/mesh/mesh_mass.hpp"
#include "sim-server/scene/mesh/triangle_mesh.hpp"

namespace splash::sim {

/// Where a mesh is pointed or sharp: what meets the water first, and would be missed by points that
/// only lie on its faces.
struct Ridges {
  std::vector<Vector3> edges;  ///< points along them, without their ends [m]
  std::vector<Vector3> tips;   ///< their ends, and tips of cones [m]
};

/// Edges are those at which the surface turns outwards by more than 30 degrees, with points no
/// farther apart than `step` [m]; tips are vertices at which they end, or around which more than 30
/// degrees of the full turn are missing. Of a sound mesh.
[[nodiscard]] Ridges find_ridges(const TriangleMesh& mesh, double step);

struct MeshSolid {
  TriangleMesh surface;
  Vector3 lower = {0.0, 0.0, 0.0};  ///< of the box around it [m]
  Vector3 upper = {0.0, 0.0, 0.0};
  MeshMass mass;
  MeshDistance distance;              ///< exact
  Vector3 deepest = {0.0, 0.0, 0.0};  ///< where it is thickest [m]
  Ridges ridges;                      ///< where it is sharp, two points to a spacing
  double spacing = 0.0;               ///< of the particles around it [m]

  /// The distance on a grid, four nodes to a spacing. Made when it is first asked for, which may
  /// take seconds: who only reads a scene does not wait.
  [[nodiscard]] const DistanceField& field() const;

 private:
  mutable std::once_flag made_;
  mutable DistanceField field_;
};

/// Moves all vertices [m].
void move_mesh(TriangleMesh& mesh, const Vector3& way);

/// For water whose particles are `spacing` [m] apart. Throws program::ConfigError if the surface
/// is none of a solid (soundness.hpp), if the largest ball within it is smaller than a particle, or
/// if it is so large that its field would have more than kFieldNodesMax nodes.
[[nodiscard]] std::shared_ptr<const MeshSolid> make_solid(TriangleMesh surface, double spacing);

}  // namespace splash::sim
