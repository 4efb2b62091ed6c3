// SPDX-License-Identifier: MIT
// Air below the water's level: a hollow that is open to the air above, and pockets that the water
// has closed around (fluid/air/air_cells.hpp).
#pragma once

#include <functional>
#include <span>

#include "sim-server/gauge/water_state.hpp"

namespace splash::sim {

struct Cavity {
  double open = 0.0;      ///< [m3]
  double enclosed = 0.0;  ///< all pockets [m3]
  double pocket = 0.0;    ///< the largest of them [m3]
};

/// `points`: the water with its images; `lower`, `upper`: the region, whose top is the level [m];
/// `solid`: whether a body is at a place.
[[nodiscard]] Cavity find_cavity(std::span<const Vector3> points, const WaterState& water,
                                 const Vector3& lower, const Vector3& upper,
                                 const std::function<bool(const Vector3&)>& solid);

}  // namespace splash::sim
