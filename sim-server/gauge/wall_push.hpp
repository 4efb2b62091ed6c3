// SPDX-License-Identifier: MIT
// What the tank's walls do to the water: the forces that sensors in walls feel, computed on the
// device by the formula that moves the particles.
#pragma once

#include <vector>

#include "sim-server/device/buffer.hpp"
#include "sim-server/device/kernel.hpp"
#include "sim-server/fluid/fluid.hpp"

namespace splash::sim {

class WallPush {
 public:
  /// Builds the kernel; throws std::runtime_error for the device.
  explicit WallPush(Fluid& fluid);

  /// On each particle, in the fluid's order [m/s2]; waits. The fluid is prepared, with walls where
  /// `step` has them.
  [[nodiscard]] std::vector<Vector3> read(Fluid& fluid, const Step& step);

 private:
  Kernel push_by_walls_;
  Buffer<float> push_;
};

}  // namespace splash::sim
