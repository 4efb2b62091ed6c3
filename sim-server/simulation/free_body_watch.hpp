// SPDX-License-Identifier: MIT
// Checks the free bodies after a frame, and copies their states from the device to the host.
#pragma once

#include <optional>

#include "sim-server/bodies/body_steps.hpp"
#include "sim-server/fluid/fluid.hpp"

namespace splash::sim {

/// Returns a fault when a free body has NaN or infinity in its state, its centre is beyond a side
/// or the floor of the tank, or it is ten times as fast as sound. To be called after the frame's
/// last step, number `step`.
[[nodiscard]] std::optional<Diagnosis> look_at_free_bodies(Fluid& fluid, int step);

/// Copies the states that the bodies have at `seconds` from the device.
void bring_free_bodies(Fluid& fluid, Bodies& bodies, double seconds);

}  // namespace splash::sim
