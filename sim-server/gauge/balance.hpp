// SPDX-License-Identifier: MIT
// Sums over all water: energies, momentum, where it is and how fast.
#pragma once

#include "sim-server/gauge/water_state.hpp"

namespace splash::sim {

struct Energies {
  double kinetic = 0.0;      ///< sum m v^2 / 2 [J]
  double potential = 0.0;    ///< -sum m g.x at the moment of the velocities, 0 at the origin [J]
  double compression = 0.0;  ///< sum m e, see compression_energy [J]
  [[nodiscard]] double total() const { return kinetic + potential + compression; }
};

struct Momentum {
  Vector3 sum = {0.0, 0.0, 0.0};  ///< sum m v [kg m/s]
  double fastest = 0.0;           ///< [m/s]
  double rms = 0.0;               ///< sqrt(mean v^2) [m/s]
};

struct Spread {
  Vector3 centre = {0.0, 0.0, 0.0};     ///< of mass [m]
  Vector3 deviation = {0.0, 0.0, 0.0};  ///< sqrt(mean (x - centre)^2) per axis [m]
};

/// Energy stored in water of this density and peak density, per mass [J/kg]: the integral of p /
/// rho^2 with the p of fluid/pressure/state_equation.h, c0^2 (ln(rho/rho0) + rho0/rho - 1) of what
/// is compressed and b c0^2 (peak - rho)^2 / (2 rho0^2) of what is stretched.
[[nodiscard]] double compression_energy(const WaterState& water, double density, double peak);

/// `water` has densities.
[[nodiscard]] Energies energies(const WaterState& water);
[[nodiscard]] Momentum momentum(const WaterState& water);
[[nodiscard]] Spread spread(const WaterState& water);

}  // namespace splash::sim
