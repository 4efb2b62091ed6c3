// SPDX-License-Identifier: MIT
// Water on a lattice, for gauges to be held against closed forms.
#pragma once

#include <functional>

#include "sim-server/gauge/water_state.hpp"

namespace splash::sim {

/// At rest, one particle per cube of `spacing`, half a spacing from the faces of the box, where
/// `inside` says so. Its lattice sum is one: the colour deep inside is 1.
[[nodiscard]] WaterState lattice_water(const Vector3& lower, const Vector3& upper, double spacing,
                                       const std::function<bool(const Vector3&)>& inside);
[[nodiscard]] WaterState lattice_water(const Vector3& lower, const Vector3& upper, double spacing);

}  // namespace splash::sim
