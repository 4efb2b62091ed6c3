// SPDX-License-Identifier: MIT
// The water at one instant, copied from the device into double precision: what gauges look at; and
// sums over all of it: energies, momentum, where it is and how fast.
#pragma once

#include <vector>

#include "sim-server/fluid/fluid.hpp"

namespace splash::sim {

/// Particles that all have the same mass. Density, peak density, pressure and image are empty
/// unless they were asked for.
struct WaterState {
  std::vector<Vector3> position;     ///< [m]
  std::vector<Vector3> velocity;     ///< [m/s]
  std::vector<double> density;       ///< [kg/m3]
  std::vector<double> peak_density;  ///< below it water pulls (pressure/state_equation.h) [kg/m3]
  std::vector<double> pressure;      ///< [Pa]
  std::vector<double> image;         ///< R of fluid/boundary/body_image.h; near bodies [1]
  std::vector<Vector3> slope;        ///< grad R; near bodies [1/m]
  std::vector<Vector3> wall_push;    ///< what the walls do to each (gauges.hpp) [m/s2]

  double mass = 0.0;          ///< of one particle [kg]
  double spacing = 0.0;       ///< dp [m]
  double support = 0.0;       ///< H of the kernel [m]
  double rest_density = 0.0;  ///< rho0 [kg/m3]
  double sound_speed = 0.0;   ///< c0 [m/s]
  double viscous = 0.0;       ///< 10 nu [m2/s], as in fluid_params.h
  double artificial = 0.0;    ///< alpha c0 h [m2/s]
  double lag = 0.0;           ///< time by which the velocities are older than the positions [s]
  double point_weight = 1.0;  ///< a body's point weighs this more than the water it displaces [1]
  Vector3 gravity = {0.0, 0.0, 0.0};      ///< [m/s2]
  Vector3 pull = {0.0, 0.0, 0.0};         ///< squared rates of the central field [1/s2]
  Vector3 pull_centre = {0.0, 0.0, 0.0};  ///< [m]

  /// Volume a particle takes up at rest [m3].
  [[nodiscard]] double volume() const { return mass / rest_density; }
  /// By gravity and the central field [m/s2].
  [[nodiscard]] Vector3 field_at(const Vector3& place) const;
  /// What raises water against them to there [J/kg].
  [[nodiscard]] double potential_at(const Vector3& place) const;
};

/// Reads the fluid's state and waits for it; `pressures`: density, pressure and image, too, which
/// must be those of the state (Fluid::prepare makes them so).
[[nodiscard]] WaterState read_water(Fluid& fluid, bool pressures);

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
