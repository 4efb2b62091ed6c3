// SPDX-License-Identifier: MIT
// Small motions of particles at rest on a lattice are waves e exp(i k x). By them the density of a
// particle, in that at rest, grows by i s . e,
//   s(k) = V sum_j F(|x_j|) x_j sin(k . x_j),
// grad W(x) = F x, V the volume of a particle; by pressure c0^2 (rho - rho0) it swings at c0 |s|.
#pragma once

#include <vector>

#include "sim-server/scene/scene.hpp"

namespace splash::sim {

/// The places of a lattice around a particle, nearer than `reach` [m]: `basis` [1] are those in one
/// cube, whose particles have `spacing`^3 each.
[[nodiscard]] std::vector<Vector3> lattice(const std::vector<Vector3>& basis, double spacing,
                                           double reach);

/// The largest |s(k)| of all waves, by climbing from many places [1/m]. `places` are the
/// neighbours, no farther than `support` [m], `volume` a particle's [m3].
[[nodiscard]] double steepest_wave(const std::vector<Vector3>& places, double volume,
                                   double support);

}  // namespace splash::sim
