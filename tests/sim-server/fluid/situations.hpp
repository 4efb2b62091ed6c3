// SPDX-License-Identifier: MIT
// The states of water that kernels are compared with their reference implementations on, each with
// what it is hard for.
#pragma once

#include <vector>

#include "tests/sim-server/fluid/small_water.hpp"

namespace splash::sim {

[[nodiscard]] std::vector<Water> situations();

[[nodiscard]] Water resting_lattice();
/// Random places in the corner of a tank, drawn to a point.
[[nodiscard]] Water crowd();
/// Random places in and above a tank.
[[nodiscard]] Water spray();
/// Above the slope's foot the floor and the slope change places; the piston stands in the tank.
[[nodiscard]] Water beach();

/// Two turned, moving bodies in shallow water.
[[nodiscard]] Water two_bodies();

}  // namespace splash::sim
