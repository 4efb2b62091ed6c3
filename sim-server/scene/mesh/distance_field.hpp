// SPDX-License-Identifier: MIT
// A mesh's signed distance sampled on a grid, linear along each axis between its nodes, and beyond
// the grid that at its nearest place and the way to there: what the device looks up.
//
// Distances change by no more than the way, so between nodes `cell` apart the error is at most
// sqrt(3)/2 cell, wherever the surface is; before a face none, and before one of curvature 1/R at
// most cell^2 / (4 R), as both principal curvatures of the distance are at most 1/R there.
#pragma once

#include <array>
#include <vector>

#include "sim-server/scene/mesh/mesh_distance.hpp"

namespace splash::sim {

/// So many nodes a field may have: 32 MiB, and ten seconds of work.
inline constexpr double kFieldNodesMax = 8.0 * 1024 * 1024;

struct DistanceField {
  Vector3 lower = {0.0, 0.0, 0.0};  ///< its first node [m]
  double cell = 0.0;                ///< between nodes [m]
  std::array<int, 3> nodes = {0, 0, 0};
  std::vector<float> values;  ///< x fastest [m]

  /// [m], negative inside.
  [[nodiscard]] double at(const Vector3& place) const;
  /// The most that it can be wrong by within the grid, sqrt(3)/2 cell [m].
  [[nodiscard]] double error() const;
};

/// How many nodes a field from `margin` before to `margin` behind a box has.
[[nodiscard]] double field_nodes(const Vector3& lower, const Vector3& upper, double cell,
                                 double margin);

/// Throws std::length_error if it would have more than kFieldNodesMax.
[[nodiscard]] DistanceField sample_distance(const MeshDistance& distance, const Vector3& lower,
                                            const Vector3& upper, double cell, double margin);

}  // namespace splash::sim
