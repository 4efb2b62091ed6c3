// SPDX-License-Identifier: MIT
// Which solver a scene with `solver: auto` gets: it follows from the scene file alone, before time
// begins. The grid suits water that stands, runs in waves, carries bodies and is struck by them;
// the state equation what flows off by itself, sheets of water, and what only it has
// (sim-server/fluid/README, "Which solver").
#pragma once

#include <string>

#include "sim-server/scene/scene.hpp"

namespace splash::sim {

/// As scene files spell it.
[[nodiscard]] std::string name_of(PressureKind solver);

struct SolverChoice {
  PressureKind solver = PressureKind::weakly_compressible;
  std::string reason;  ///< half a sentence that says why
};

/// The solver that suits the scene, whatever it names.
[[nodiscard]] SolverChoice suitable_solver(const Scene& scene);

/// The scene's solver and the reason for it. If the scene names the grid although another solver
/// suits it, the notice says why that is so.
[[nodiscard]] std::string solver_notice(const Scene& scene);

}  // namespace splash::sim
