// SPDX-License-Identifier: MIT
// What became of the free bodies in a frame: whether it can be, and from the device to the host.
#pragma once

#include <optional>

#include "sim-server/bodies/body_steps.hpp"
#include "sim-server/fluid/fluid.hpp"

namespace splash::sim {

/// Once the frame's last step, number `step`, is done: a free body whose numbers are none, whose
/// centre is beyond a side or the floor of the tank, or which is ten times as fast as sound.
[[nodiscard]] std::optional<Diagnosis> look_at_free_bodies(Fluid& fluid, int step);

/// The bodies are where the device has brought them by `seconds`.
void bring_free_bodies(Fluid& fluid, Bodies& bodies, double seconds);

}  // namespace splash::sim
