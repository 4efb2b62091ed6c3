// SPDX-License-Identifier: MIT
// The states of water that kernels are compared with their reference implementations on, each with
// what it is hard for.
#pragma once

#include <vector>

#include "tests/sim-server/fluid/small_water.hpp"

namespace splash::sim {

[[nodiscard]] std::vector<Water> situations();

/// Particles at one x, few in each row of cells: a vector of neighbours that starts in one row runs
/// on into the next, whose particles are neighbours too and must not count twice.
[[nodiscard]] Water spray_curtain();

/// Two turned, moving bodies in shallow water.
[[nodiscard]] Water two_bodies();
/// The same of meshes, one of them askew and beside its own origin.
[[nodiscard]] Water two_meshes();

}  // namespace splash::sim
