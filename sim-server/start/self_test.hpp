// SPDX-License-Identifier: MIT
// Whether a device computes what it should: some steps of a small cube of water, held against sums
// on the host.
#pragma once

#include <functional>

#include "sim-server/device/device.hpp"

namespace splash::sim {

/// Densities and accelerations of some hundred particles are summed up once more in double
/// precision; momentum must stay, all particles must be there, and the same steps give the same
/// bits. Calls `built` once the kernels are there. Returns what a step takes [s].
/// Throws DeviceError that says what is wrong.
double self_test(Device& device, const std::function<void()>& built);

}  // namespace splash::sim
