// SPDX-License-Identifier: MIT
// Sloshing along a tank, by linear theory: its modes in a velocity field, and how fast real water
// loses it.
#pragma once

#include <vector>

#include "sim-server/scene/scene.hpp"
#include "tests/validation/series.hpp"

namespace splash::validation {

/// A tank and the water that is in it when level [m].
struct Basin {
  double length = 0.0;  ///< along x, from 0, in which the water sloshes
  double width = 0.0;
  double depth = 0.0;  ///< above z = 0
};

/// Rms speeds [m/s].
struct Parts {
  double sloshing = 0.0;
  double rest = 0.0;
};

/// Splits velocities at `places` into the six lowest modes of sloshing, potential flows with the
/// wave numbers n pi / length, by least squares, and the rest.
[[nodiscard]] Parts split(const Basin& basin, const std::vector<sim::Vector3>& places,
                          const std::vector<sim::Vector3>& velocities);

/// Rate at which the lowest mode's amplitude falls where water rubs on the floor and four walls, by
/// Stokes layers (Keulegan 1959) [1/s]; `viscosity`: [m2/s], `gravity`: [m/s2].
[[nodiscard]] double wall_decay(const Basin& basin, double viscosity, double gravity);

/// Rate at which the amplitude of y, which swings about 0, falls from `first` on, by its largest
/// values between zero crossings [1/s]; not a number where there are fewer than three.
[[nodiscard]] double swing_decay(const Column& time, const Column& y, double first);

}  // namespace splash::validation
