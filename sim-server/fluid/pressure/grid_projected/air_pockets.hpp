// SPDX-License-Identifier: MIT
// Air that is shut in by water and solids (pockets.cl), and how it enters the pressures' system
// (pocket.h).
#pragma once

#include <vector>

#include "sim-server/device/buffer.hpp"
#include "sim-server/device/kernel.hpp"
#include "sim-server/fluid/pressure/grid_projected/mac_fields.hpp"
#include "sim-server/fluid/pressure/grid_projected/pocket.h"
#include "sim-server/fluid/pressure/grid_projected/solids.hpp"
#include "sim-server/fluid/pressure/pressure_solver.hpp"

namespace splash::sim {

class ShutInAir {
 public:
  /// `looks`: whether the scene asks for it (air_pockets); otherwise none is ever found. Throws
  /// DeviceError if it does and the device solves with many work-items.
  ShutInAir(Device& device, const cl::Program& program, const MacFields& fields,
            const GridSolids& solids, bool looks);

  /// Finds it where the water and the solids are as the step begins.
  void find(Fluid& fluid, const Step& step);
  /// The pockets of the last step. Waits for the device.
  [[nodiscard]] std::vector<AirPocket> read(Device& device) const;

  /// State that the next step depends on.
  [[nodiscard]] std::vector<cl::Buffer> kept() const {
    if (!looks_) return {};
    return {was_.memory(), pockets_.memory()};
  }
  void forget(Device& device);

  /// q of pockets' cells [1/m2].
  [[nodiscard]] const Buffer<float>& compliance() const noexcept { return compliance_; }
  [[nodiscard]] const Buffer<AirPockets>& pockets() const noexcept { return pockets_; }
  /// Numbers of their cells.
  [[nodiscard]] const Buffer<int>& list() const noexcept { return list_; }

 private:
  const MacFields& fields_;
  const GridSolids& solids_;
  bool looks_;
  Buffer<float> compliance_;
  Buffer<AirPockets> pockets_;
  Buffer<int> list_;
  Buffer<int> label_;
  Buffer<int> was_;  ///< what cells were in the last step (pockets.cl)
  Buffer<float> counted_;
  Kernel find_pockets_;
};

}  // namespace splash::sim
