// SPDX-License-Identifier: MIT
// Bodies that the water moves, as unknowns of the pressures' system (coupling.h), and the springs
// that they may hang on (hang.cl).
#pragma once

#include "sim-server/device/buffer.hpp"
#include "sim-server/device/kernel.hpp"
#include "sim-server/fluid/params/fluid_params.h"
#include "sim-server/fluid/pressure/grid_projected/mac_fields.hpp"
#include "sim-server/fluid/pressure/grid_projected/solids.hpp"
#include "sim-server/fluid/time_step.hpp"

namespace splash::sim {

class CoupledBodies {
 public:
  CoupledBodies(Device& device, const cl::Program& program, const MacFields& fields,
                const GridSolids& solids);

  /// Makes room for `count` free bodies.
  void release(Device& device, std::size_t count);
  /// Gives the bodies the velocities that they would have after the step without the water's
  /// pressures, and finds the water that they entrain (entrained.cl).
  void let_fall(Fluid& fluid, const Step& step);
  /// Finds K (coupling.h) of the cells beside the bodies. The system has been laid.
  void find_grip(Fluid& fluid, const Step& step);
  /// Finds the same for `count` other bodies and writes it to `grip`.
  void find_grip(Fluid& fluid, const Step& step, int count, const Buffer<FreeBody>& bodies,
                 const Buffer<float>& grip);
  /// Gives the bodies the change of velocity by the pressures `found`, the system's solution.
  void push(Fluid& fluid, const Step& step, const Buffer<float>& found);

  /// The number of free bodies; 0 before they are released.
  [[nodiscard]] int count(Fluid& fluid) const;
  /// The free bodies, with what their springs add to their inertia.
  [[nodiscard]] const Buffer<FreeBody>& solved(Fluid& fluid) const;
  [[nodiscard]] const Buffer<float>& grip() const noexcept { return grip_; }
  /// The water that goes with each free body.
  [[nodiscard]] const Buffer<float>& entrained() const noexcept { return entrained_; }

  /// State that the next step depends on.
  [[nodiscard]] std::vector<cl::Buffer> kept() const {
    if (!released_) return {};
    return {kept_.memory()};
  }
  void forget(Device& device) { kept_.enqueue_clear(device); }

 private:
  /// Makes bodies as heavy as their springs do.
  void tie(Fluid& fluid, const Step& step);
  /// Whether a spring ties any free body to a haptic device or a tracker.
  [[nodiscard]] bool any_hung(Fluid& fluid) const;
  [[nodiscard]] const Buffer<FreeBody>& frees(Fluid& fluid) const;

  const MacFields& fields_;
  const GridSolids& solids_;
  Buffer<FreeBody> no_body_;
  Buffer<float> grip_;  ///< K of each cell
  Buffer<float> entrained_;
  bool released_ = false;  ///< some are free
  Buffer<float> kept_;
  Buffer<FreeBody> tied_;  ///< as heavy as springs make them
  Buffer<float> tuggings_;
  Kernel let_fall_;
  Kernel entrain_water_;
  Kernel grip_water_;
  Kernel push_bodies_;
  Kernel tie_bodies_;
  Kernel tell_tugs_;
};

}  // namespace splash::sim
