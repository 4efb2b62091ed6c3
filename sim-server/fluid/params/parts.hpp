// SPDX-License-Identifier: MIT
// How the kernels are built: their sources, and what of them a scene needs.
#pragma once

#include <string>
#include <vector>

#include "sim-server/device/kernel.hpp"
#include "sim-server/fluid/params/fluid_params.h"

namespace splash::sim {

// The parts of the kernels that a scene needs. Programs are built without the rest: without bodies
// no kernel looks for them, without a slope every wall is a mirror, and so on.

struct KernelParts {
  bool bodies = true;
  bool slope = true;
  bool piston = true;
  bool friction = true;  ///< either viscosity
  bool mesh = true;      ///< a body that is one
  bool pockets = true;   ///< air that is shut in

  /// How many a program is built without.
  [[nodiscard]] int left_out() const noexcept;
};

[[nodiscard]] KernelParts parts_needed(const FluidParams& params,
                                       const std::vector<BodyShape>& shapes);

/// Whether the environment variable SPLASH_WHOLE is set. Kernels then have every part, so that all
/// scenes share the same compiled programs.
[[nodiscard]] bool whole_asked();

/// What programs with these parts are built with.
[[nodiscard]] std::vector<std::string> kernel_defines(const KernelParts& parts);

// The fluid's kernels as they are built: the stages of a step, and apart from them those of the
// grid-projected solver, of free bodies, of a turning tank and the statistics.

namespace kernels {
[[nodiscard]] std::vector<KernelSource> fluid();
[[nodiscard]] std::vector<KernelSource> grid_projected();
[[nodiscard]] std::vector<KernelSource> free_bodies();
[[nodiscard]] std::vector<KernelSource> tank_turn();
[[nodiscard]] std::vector<KernelSource> stats();
}  // namespace kernels

}  // namespace splash::sim
