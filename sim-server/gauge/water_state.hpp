// SPDX-License-Identifier: MIT
// The water at one instant, copied from the device into double precision: what gauges look at.
#pragma once

#include <vector>

#include "sim-server/fluid/fluid.hpp"

namespace splash::sim {

/// Particles that all have the same mass. Density and pressure are empty unless they were asked
/// for.
struct WaterState {
  std::vector<Vector3> position;  ///< [m]
  std::vector<Vector3> velocity;  ///< [m/s]
  std::vector<double> density;    ///< [kg/m3]
  std::vector<double> pressure;   ///< [Pa]

  double mass = 0.0;          ///< of one particle [kg]
  double spacing = 0.0;       ///< dp [m]
  double support = 0.0;       ///< H of the kernel [m]
  double rest_density = 0.0;  ///< rho0 [kg/m3]
  double sound_speed = 0.0;   ///< c0 [m/s]
  double viscous = 0.0;       ///< 10 nu [m2/s], as in fluid_params.h
  double artificial = 0.0;    ///< alpha c0 h [m2/s]
  double point_weight = 1.0;  ///< a body's point weighs this more than the water it displaces [1]
  Vector3 gravity = {0.0, 0.0, 0.0};  ///< [m/s2]

  /// Volume a particle takes up at rest [m3].
  [[nodiscard]] double volume() const { return mass / rest_density; }
};

/// Reads the fluid's state and waits for it; `pressures`: density and pressure, too, which must be
/// those of the state (Fluid::prepare makes them so).
[[nodiscard]] WaterState read_water(Fluid& fluid, bool pressures);

}  // namespace splash::sim
