// SPDX-License-Identifier: MIT
// From a scene to the numbers the kernels work with.
#pragma once

#include <vector>

#include "sim-server/fluid/params/fluid_params.h"
#include "sim-server/scene/scene.hpp"
#include "sim-server/scene/support_state.hpp"

namespace splash::sim {

/// Support of the smoothing kernel in a scene [m].
[[nodiscard]] double scene_support(const Scene& scene);

/// Walls: the floor first, then the sides (smallest x first: the piston), then the slope.
[[nodiscard]] std::vector<WallPlane> tank_walls(const Scene& scene);
/// The gate, for the water to its `left`, at smaller x, or to its right.
[[nodiscard]] WallPlane gate_wall(const Gate& gate, bool left);

/// For so many `particles`, each of which has the volume of a cell of the lattice
/// (scene/lattice.hpp). Its mass is such that the lattice has the density at rest, and more by what
/// the deepest column loses in height when it settles, its mean compression g H / (2 c0^2): the
/// water stands at the wanted level, and its outermost particles kSurfaceLoss lower than on the
/// lattice (smoothing.hpp). `sound_speed`: of the water [m/s]; without it, scene_sound_speed.
[[nodiscard]] FluidParams make_params(const Scene& scene, const std::vector<Vector3>& particles,
                                      double sound_speed);
[[nodiscard]] FluidParams make_params(const Scene& scene, const std::vector<Vector3>& particles);

/// The particles as they stand under their own weight: density grows with depth as the state
/// equation asks, rho = rho0 (1 + g (H - z) / c0^2), so nothing falls in the first steps and the
/// surface stays where the scene wants it. To first order z becomes z - g z (H - z) / (2 c0^2),
/// with z from the floor, or from the bottom of a column that stands higher. What hangs, as
/// `support_states` says of each particle (all are held without it), weighs on nothing and stays
/// where it is. Needs gravity along -z; any other leaves the lattice as it is. `sound_speed`: c0
/// [m/s].
[[nodiscard]] std::vector<Vector3> settled(const Scene& scene, std::vector<Vector3> particles,
                                           double sound_speed,
                                           const std::vector<SupportState>& support_states = {});

/// How far the piston stands in front of its rest place, and how fast it moves [m], [m/s].
struct PistonState {
  double offset = 0.0;
  double speed = 0.0;
};
[[nodiscard]] PistonState piston_at(const WaveMaker& maker, double seconds);
/// The tank as it is then: a wave maker's wall is where its piston is.
[[nodiscard]] Tank tank_at(const Scene& scene, double seconds);

}  // namespace splash::sim
