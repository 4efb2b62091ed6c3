// SPDX-License-Identifier: MIT
// How finely a scene's water is resolved, and how stiff it is: what follows from the whole scene.
#pragma once

#include "sim-server/scene/scene.hpp"

namespace splash::sim {

/// The surface of the particles is this rough: nearer, body and water touch [spacings].
inline constexpr double kSurfaceRoughness = 0.1;

inline constexpr int kParticlesMin = 100;
inline constexpr int kParticlesMax = 4'000'000;

/// Height of the floor at `x`, slope included [m].
[[nodiscard]] double floor_height(const Scene& scene, double x);
/// Whether `x` is beyond a side of the tank or below its floor.
[[nodiscard]] bool is_outside(const Scene& scene, const Vector3& x);
/// Water at rest above the floor and the slope, bodies not subtracted [m3].
[[nodiscard]] double water_volume(const Scene& scene);
/// As given, or such that the wanted number of particles fills the water [m].
[[nodiscard]] double particle_spacing(const Scene& scene);
/// Water that is one on the other over a place, with gaps of less than a spacing.
struct WaterColumn {
  double bottom = 0.0;  ///< the floor's height there, or that of the lowest block [m]
  double top = 0.0;     ///< [m]
};
/// The column of water that `place` is in; of no height where there is none.
[[nodiscard]] WaterColumn water_column(const Scene& scene, const Vector3& place);
/// Height of the deepest column of water at the start [m].
[[nodiscard]] double water_depth(const Scene& scene);
/// The fastest wave that the depth allows, sqrt(g H); in a central field g H is the energy per mass
/// between a block's places farthest from its centre and nearest to it [m/s].
[[nodiscard]] double longest_wave(const Scene& scene);
/// Speed of the wave maker's piston in the middle of its way, pi stroke / period [m/s].
[[nodiscard]] double fastest_piston(const WaveMaker& maker);
/// What free bodies, and water that hangs in the air, get at most by falling through the tank, with
/// the speed that they begin with, and what a block of water gets by the central field:
/// sqrt(v^2 + 2 g drop) [m/s]. Nothing is said of what falls upwards out of the tank, which is open
/// there.
[[nodiscard]] double fastest_fall(const Scene& scene);
/// The speed of sound that suits a scene, whether or not it names one: from the depth, times
/// `sound_factor` (StepPolicy), and from the speed of what is fastest: the body that `fastest_body`
/// is of, what falls, or the piston [m/s].
[[nodiscard]] double suitable_sound_speed(const Scene& scene, double fastest_body,
                                          double sound_factor);
/// The speed that the scene names, or the suitable one at its steps [m/s].
[[nodiscard]] double scene_sound_speed(const Scene& scene, double fastest_body = 0.0);
/// The least speed of sound that a scene may name [m/s]: neither its own weight, g H / c^2, nor the
/// stagnation of what falls (fastest_fall), of a uniform flow or at the piston, v^2 / 2 c^2, makes
/// its water denser by more than a sixteenth. Sound that the scene leaves to us is at least as fast
/// at any step.
[[nodiscard]] double slowest_sound(const Scene& scene);
/// g / c0^2: relative growth of density per depth in water that stands, in which sound is as fast
/// as `sound_speed` [m/s]; 0 where nothing compresses or gravity is not along -z [1/m].
[[nodiscard]] double stratification(const Scene& scene, double sound_speed);
/// The part of its height that the deepest column loses by its own weight, its mean compression
/// [1].
[[nodiscard]] double compression(const Scene& scene, double sound_speed);

}  // namespace splash::sim
