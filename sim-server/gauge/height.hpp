// SPDX-License-Identifier: MIT
// How high the water stands over a place: where the colour field on a vertical line falls to a
// half.
//   colour(z) = sum_j V W(|x_j - (x, y, z)|),  V = m / rho0, walls mirrored
// Half is the value on a flat surface, and more than a lone particle has (0.42): drops do not
// count.
#pragma once

#include <span>

#include "sim-server/gauge/water_state.hpp"

namespace splash::sim {

struct Height {
  double top = 0.0;     ///< of the highest water above the floor; 0: dry [m]
  double wetted = 0.0;  ///< length of the line that is in water, as a wire gauge reads it [m]
};

/// Points less than `reach` from the vertical line [m].
[[nodiscard]] std::vector<Vector3> near_line(std::span<const Vector3> points, double x, double y,
                                             double reach);

/// `points`: the water with its images; `x`, `y`: the line; `floor`: where it begins [m].
[[nodiscard]] Height water_height(std::span<const Vector3> points, const WaterState& water,
                                  double x, double y, double floor);

}  // namespace splash::sim
