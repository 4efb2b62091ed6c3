// SPDX-License-Identifier: MIT
// What the water does to bodies that go their own way, while somebody feels it: the pressures'
// force with its derivative by the body's speed (felt.cl), and the momentum given beyond these.
#pragma once

#include <optional>

#include "sim-server/device/buffer.hpp"
#include "sim-server/device/kernel.hpp"
#include "sim-server/fluid/pressure/grid_projected/coupling.hpp"
#include "sim-server/fluid/pressure/grid_projected/given.hpp"
#include "sim-server/fluid/pressure/grid_projected/mac_fields.hpp"
#include "sim-server/fluid/pressure/grid_projected/solids.hpp"
#include "sim-server/fluid/pressure/grid_projected/system.hpp"
#include "sim-server/fluid/pressure/pressure_solver.hpp"

namespace splash::sim {

class FeltForces {
 public:
  FeltForces(Device& device, const cl::Program& program, const MacFields& fields,
             const GridSolids& solids, CoupledBodies& bodies, PressureSystem& system);

  /// Turns the computation of felt forces on or off, from the next step on.
  void feel(Device& device, bool on);
  [[nodiscard]] bool feels() const noexcept { return feels_; }
  /// Sets the bodies whose forces weigh() finds in this step.
  void add(const FeltBodies& felt);
  /// Adds this step's forces to the bodies' sums. The particles have moved.
  void weigh(Fluid& fluid, const Step& step);
  /// Of each particle, the change of velocity by bodies other than by the grid's pressure, which
  /// find_spacing and move_particles write [m/s].
  [[nodiscard]] const Buffer<float>& jolt() const noexcept { return given_.jolt(); }
  [[nodiscard]] const GivenMomentum& given() const noexcept { return given_; }
  /// Clears what a failed step left, which later steps would begin from.
  void forget(Device& device) { answer_.enqueue_clear(device); }

 private:
  /// The derivative by one `part` of the speed of body `k`, or what its flow gives far from it.
  void weigh_answer(Fluid& fluid, const Step& step, int k, int part);
  /// Adds the force on each body by the solution `found` or, with a body `only`, the derivative of
  /// its force by that part of its speed.
  void weigh_pressure(Fluid& fluid, const Step& step, const Buffer<float>& found, int only = -1,
                      int part = 0);

  const MacFields& fields_;
  const GridSolids& solids_;
  CoupledBodies& bodies_;
  PressureSystem& system_;
  GivenMomentum given_;
  bool feels_ = false;
  std::optional<FeltBodies> now_;  ///< of this step, until it has moved the particles
  Buffer<float> grip_;             ///< K of each cell
  Buffer<float> answer_;
  Buffer<SolveState> answer_state_;
  Kernel weigh_pressure_;
  Kernel ask_for_answer_;
};

}  // namespace splash::sim
