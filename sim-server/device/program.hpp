// SPDX-License-Identifier: MIT
// Kernel sources to programs, with build errors that name the kernel's own file and line.
#pragma once

#include <string>
#include <vector>

#include "sim-server/device/device.hpp"
#include "sim-server/device/kernel.hpp"

namespace splash::sim {

struct KernelSource {
  std::string name;  ///< the file's path in the source tree
  std::string text;
};

/// Builds `sources` as one program. `defines`: "NAME=VALUE" build constants; keep them few, each
/// combination is compiled and cached apart.
/// Throws DeviceError with the compiler's log.
[[nodiscard]] cl::Program build_program(const Device& device,
                                        const std::vector<KernelSource>& sources,
                                        const std::vector<std::string>& defines);

}  // namespace splash::sim
