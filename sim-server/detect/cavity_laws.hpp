// SPDX-License-Identifier: MIT
// What is known of the hollow behind a body that hit the water and goes in: when it closes, how
// much air it shuts in, and how that air rings. R is the radius of the disc with the area that the
// body shows from below; Fr = u^2 / (g R).
#pragma once

namespace splash::sim {

/// From the slap until gravity closes the hollow, whatever the speed: 2.285 sqrt(R / g) (Glasheen &
/// McMahon 1996; spheres from 1.72 on) [s].
[[nodiscard]] double closing_time(double radius, double gravity);

/// Air that it shuts in: C R^3 Fr^1/2 (1 + 0.26 Fr^1/2) (Bergmann et al. 2009, arXiv 0804.0748)
/// [m3]. C is not in that abstract; a cone as deep as the body at the closing holds 2, and 1.5 to 3
/// are likely.
[[nodiscard]] double closed_volume(double radius, double speed, double gravity,
                                   double coefficient = 2.0);

/// Radius of the sphere of that volume [m].
[[nodiscard]] double sphere_radius(double volume);

/// Initial excitation of the closed air, as a part of its radius: the root of the sum of squares of
///   rho g z / (3 gamma p0)      air of the atmosphere's pressure in water of depth z, and
///   |dV/dt| / (3 V w0)          water that still closes in, w0 r = 2 pi 3.26 m/s (Minnaert 1933),
/// within 0.002 and 0.1. dV/dt is at most V by the time 0.915 r / sqrt(g z) in which an empty
/// hollow collapses there (Rayleigh 1917), which makes it 0.018 in 10 cm of water. `depth`: of its
/// centre [m], `closing`: dV/dt [m3/s].
[[nodiscard]] double ring_excitation(double volume, double closing, double depth, double density,
                                     double gravity);

/// Until a large bubble has risen to the surface: z / (0.71 sqrt(2 g r)) (Davies & Taylor 1950)
/// [s].
[[nodiscard]] double ring_life(double radius, double depth, double gravity);

}  // namespace splash::sim
