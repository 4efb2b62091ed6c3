// SPDX-License-Identifier: MIT
// From a scene to the numbers the kernels work with.
#pragma once

#include <vector>

#include "sim-server/fluid/fluid_params.h"
#include "sim-server/scene/scene.hpp"

namespace splash::sim {

/// Support radius over particle spacing: about 30 neighbours. Chosen on cost: see docs of the
/// solver in sim-server/fluid/README.md.
inline constexpr double kSupportSpacings = 2.0;

/// Support radius H of a scene [m].
[[nodiscard]] double support_radius(const Scene& scene);

/// Walls: the floor first, then the sides (smallest x first: the piston), then the slope.
[[nodiscard]] std::vector<WallPlane> tank_walls(const Scene& scene);

/// `particles`: their initial places [m]. The mass of a particle is such that a block of the
/// initial lattice has the density at rest.
[[nodiscard]] FluidParams make_params(const Scene& scene, const std::vector<Vector3>& particles);

/// How far the piston stands in front of its rest place, and how fast it moves [m], [m/s].
struct PistonState {
  double offset = 0.0;
  double speed = 0.0;
};
[[nodiscard]] PistonState piston_at(const WaveMaker& maker, double seconds);

}  // namespace splash::sim
