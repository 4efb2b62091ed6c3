// SPDX-License-Identifier: MIT
// Particles that have come too close together or too far apart are moved until each cell holds its
// volume of water (crowding.cl).
#pragma once

#include "sim-server/device/buffer.hpp"
#include "sim-server/device/kernel.hpp"
#include "sim-server/fluid/pressure/grid_projected/mac_fields.hpp"
#include "sim-server/fluid/pressure/grid_projected/mac_grid.h"
#include "sim-server/fluid/pressure/grid_projected/solids.hpp"
#include "sim-server/fluid/pressure/grid_projected/system.hpp"

namespace splash::sim {

class Crowding {
 public:
  Crowding(Device& device, const cl::Program& program, const MacFields& fields,
           const GridSolids& solids, PressureSystem& system);

  /// Finds how the particles have to be moved in this step. The system has been solved.
  void find(Fluid& fluid, const Step& step);
  /// That, on faces, as a velocity that lasts for the step [m/s].
  [[nodiscard]] const Buffer<float>& shift() const noexcept { return shift_; }

 private:
  const MacFields& fields_;
  const GridSolids& solids_;
  PressureSystem& system_;
  Buffer<float> found_;
  Buffer<float> shift_;
  Buffer<SolveState> state_;
  Kernel ask_for_room_;
  Kernel find_shift_;
};

}  // namespace splash::sim
