// SPDX-License-Identifier: MIT
// Pressure at a point: the mean of what the particles around it say, each carried there as in water
// at rest, so that a sensor in a wall, which has water on one side only, reads no deeper or
// shallower than it lies.
//   p(x) = sum_j (p_j + rho0 g.(x - x_j)) W_j / sum_j W_j, not below 0; 0 where V sum_j W_j < 0.1
#pragma once

#include "sim-server/gauge/water_state.hpp"

namespace splash::sim {

/// `water` has pressures; `place` [m]. In Pa above that of the air.
[[nodiscard]] double pressure_at(const WaterState& water, const Vector3& place);

}  // namespace splash::sim
