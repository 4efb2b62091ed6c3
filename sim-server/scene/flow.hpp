// SPDX-License-Identifier: MIT
// How the water moves when time begins: flows with a closed form, free of divergence.
#pragma once

#include "sim-server/scene/scene.hpp"

namespace splash::sim {

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
