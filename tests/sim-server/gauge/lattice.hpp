// SPDX-License-Identifier: MIT
// Water on a lattice, for gauges to be held against closed forms.
#pragma once

#include <cmath>
#include <functional>

#include "sim-server/fluid/params/smoothing.hpp"
#include "sim-server/gauge/water_state.hpp"

namespace splash::sim {

/// At rest, one particle per cube of `spacing`, half a spacing from the faces of the box, where
/// `inside` says so; empty: everywhere. Its lattice sum is one: the colour deep inside is 1.
[[nodiscard]] inline WaterState lattice_water(
    const Vector3& lower, const Vector3& upper, double spacing,
    const std::function<bool(const Vector3&)>& inside = {}) {
  WaterState water;
  water.spacing = spacing;
  water.support = kSupportSpacings * spacing;
  water.rest_density = 1000.0;
  water.mass = 1000.0 * spacing * spacing * spacing;
  water.sound_speed = 20.0;
  water.gravity = {0.0, 0.0, -9.81};
  const auto count = [&](std::size_t axis) {
    return static_cast<int>(std::lround((upper[axis] - lower[axis]) / spacing));
  };
  for (int k = 0; k < count(2); ++k) {
    for (int j = 0; j < count(1); ++j) {
      for (int i = 0; i < count(0); ++i) {
        const Vector3 place = {lower[0] + (i + 0.5) * spacing, lower[1] + (j + 0.5) * spacing,
                               lower[2] + (k + 0.5) * spacing};
        if (!inside || inside(place)) water.position.push_back(place);
      }
    }
  }
  water.velocity.resize(water.position.size(), {0.0, 0.0, 0.0});
  return water;
}

}  // namespace splash::sim
