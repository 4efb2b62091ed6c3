// SPDX-License-Identifier: MIT
// What of the kernels a scene needs. Programs are built without the rest: without bodies nobody
// asks where they are, without a slope every wall is a mirror, and so on.
#pragma once

#include <string>
#include <vector>

#include "sim-server/fluid/params/fluid_params.h"

namespace splash::sim {

struct KernelParts {
  bool bodies = true;
  bool slope = true;
  bool piston = true;
  bool friction = true;  ///< either viscosity
  bool mesh = true;      ///< a body that is one

  /// How many a program is built without.
  [[nodiscard]] int left_out() const noexcept;
};

[[nodiscard]] KernelParts parts_needed(const FluidParams& params,
                                       const std::vector<BodyShape>& shapes);

/// What programs with these parts are built with.
[[nodiscard]] std::vector<std::string> kernel_defines(const KernelParts& parts);

}  // namespace splash::sim
