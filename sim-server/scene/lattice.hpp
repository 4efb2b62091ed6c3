// SPDX-License-Identifier: MIT
// The rows of particles that a block of water begins with.
#pragma once

#include <array>
#include <vector>

#include "sim-server/scene/scene.hpp"

namespace splash::sim {

struct Lattice {
  std::array<int, 3> counts = {};  ///< rows along x, y, z
  Vector3 step = {};               ///< from row to row [m]
  /// Of one of its cells [m3].
  [[nodiscard]] double cell() const noexcept { return step[0] * step[1] * step[2]; }
};

/// Of each block of water: whole rows fill its box exactly, as nearly a particle spacing apart
/// along each axis as that allows. No cell is larger than one of the largest block, so that each
/// has room for at most one particle.
[[nodiscard]] std::vector<Lattice> lattices(const Scene& scene);

/// Of each particle of the scene, at rest: a cell of its largest block [m3].
[[nodiscard]] double particle_volume(const Scene& scene);

}  // namespace splash::sim
