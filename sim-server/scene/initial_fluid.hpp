// SPDX-License-Identifier: MIT
// Where the water's particles are before anything moves, and how they begin to: flows with a closed
// form, free of divergence.
#pragma once

#include <span>
#include <vector>

#include "sim-server/scene/scene.hpp"

namespace splash::sim {

/// Whether a place of the block's box is inside its form.
[[nodiscard]] bool is_filled(const WaterBlock& block, const Vector3& place);

/// How much water of one block a scene wants, and how much of it there is [m3].
struct BlockWater {
  double wanted = 0.0;
  double there = 0.0;
};

struct InitialWater {
  std::vector<Vector3> particles;  ///< their middles [m], block after block
  std::vector<BlockWater> blocks;  ///< one each
};

/// The water with the bodies at `poses` (their times are ignored), one each. A block's volume is
/// that of its form above the floor and the slope, less what bodies displace of it; the block gets
/// as many particles as that volume asks for, to half a particle.
///
/// Each cell of its lattice (scene/lattice.hpp) gets as many particles, one or none, as the water
/// in it is parts of a particle's, and what rounding leaves goes on to the next cell (error
/// diffusion: Floyd & Steinberg 1976): so the number is right around each body, too. Rows
/// follow the slope; a particle is in the middle of the water of its cell. Gaps that have no room
/// for half a particle get none: it lies on top of its block instead.
///
/// Water that stands is denser below (compression, scene/resolution.hpp): so each column gets as
/// many particles as its weight asks for. The order is fixed: x fastest, then y, then z.
/// `sound_speed`: in that water [m/s].
[[nodiscard]] InitialWater initial_water(const Scene& scene, std::span<const Keyframe> poses,
                                         double sound_speed);

/// Its particles with the scene's speed of sound (scene_sound_speed); without `poses` bodies are
/// where `rest` says.
[[nodiscard]] std::vector<Vector3> initial_particles(const Scene& scene);
[[nodiscard]] std::vector<Vector3> initial_particles(const Scene& scene,
                                                     std::span<const Keyframe> poses);

/// Velocity at `place` of the scene's flow [m/s]; nothing without one.
///   uniform        velocity
///   strain         rate (x - cx, 0, cz - z)
///   standing_wave  of wave number k = mode pi / L in water of depth H, at its flat moment
///                  (Airy; Lamb, Hydrodynamics, article 228), x and z from the tank's lower corner:
///                  u = -a omega cosh(kz) / sinh(kH) sin(kx),
///                  w = a omega sinh(kz) / sinh(kH) cos(kx), omega^2 = g k tanh(kH)
///   vortex         the Taylor-Green cell (Taylor & Green 1937) between walls that do not rub:
///                  u = U sin(pi x / Lx) cos(pi y / Ly), v = -U Ly/Lx cos(pi x / Lx) sin(pi y / Ly)
[[nodiscard]] Vector3 initial_velocity(const Scene& scene, const Vector3& place);

}  // namespace splash::sim
