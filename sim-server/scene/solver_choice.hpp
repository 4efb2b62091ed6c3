// SPDX-License-Identifier: MIT
// Which solver a scene with `solver: auto` gets: it follows from the scene file alone, before time
// begins. The grid suits water that stands, runs in waves and carries bodies; on it impacts of
// bodies that enter slowly may be missed, and fast slaps may be too soft (sim-server/fluid/README,
// "Which solver").
#pragma once

#include <string>

#include "sim-server/scene/scene.hpp"

namespace splash::sim {

/// As scene files spell it.
[[nodiscard]] std::string name_of(PressureKind solver);

/// How fast a body may enter the water and yet make no slap worth the name: the impulse of a disc
/// of radius R that hits the water flat, 4/3 rho R^3 U (Batchelor 1967), is a tenth of what
/// buoyancy gives it while it goes R deep, pi/2 rho g R^4 / U, at U = sqrt(3 pi / 80 g R).
/// `radius`: half the body's smaller width [m], `gravity` [m/s2]; the result [m/s].
[[nodiscard]] double slap_speed(double radius, double gravity);

/// How fast a body enters the water from above at most, as far as its scene says: a scripted one by
/// its keyframes, a free one by falling from where it begins, or after its buoyancy made it leap
/// out, with nothing that brakes it; 0: it does not, or the scene does not say [m/s].
[[nodiscard]] double entry_speed(const Scene& scene, const BodySettings& body);

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
