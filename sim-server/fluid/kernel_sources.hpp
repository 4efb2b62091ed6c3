// SPDX-License-Identifier: MIT
// The fluid's kernels as they are built: the stages of a step, and apart from them those of the
// divergence-free solver, of free bodies and the statistics.
#pragma once

#include <vector>

#include "sim-server/device/program.hpp"

namespace splash::sim {

[[nodiscard]] std::vector<KernelSource> fluid_sources();
[[nodiscard]] std::vector<KernelSource> divergence_free_sources();
[[nodiscard]] std::vector<KernelSource> grid_projected_sources();
[[nodiscard]] std::vector<KernelSource> free_body_sources();
[[nodiscard]] std::vector<KernelSource> stats_sources();

}  // namespace splash::sim
