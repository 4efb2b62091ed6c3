// SPDX-License-Identifier: MIT
// The momentum that felt bodies give the particles beyond the grid's pressures on them (given.cl).
#pragma once

#include "sim-server/device/buffer.hpp"
#include "sim-server/device/kernel.hpp"
#include "sim-server/fluid/pressure/grid_projected/mac_fields.hpp"
#include "sim-server/fluid/pressure/grid_projected/solids.hpp"
#include "sim-server/fluid/pressure/pressure_solver.hpp"

namespace splash::sim {

class GivenMomentum {
 public:
  GivenMomentum(Device& device, const cl::Program& program, const MacFields& fields,
                const GridSolids& solids);

  /// Before the first step in which somebody feels a body.
  void make_room(Device& device);
  /// The particles moved: takes from the sums of `felt` what the bodies gave beyond the pressures
  /// `found`; or, for one of them, adds the derivative by a `part` of its speed, to which the
  /// pressures `found` are the answer.
  void weigh(Fluid& fluid, const Step& step, const FeltBodies& felt, const Buffer<float>& found,
             int only = -1, int part = 0);

  /// Of particles, by bodies other than by pressure: spacing and moving fill it [m/s].
  [[nodiscard]] const Buffer<float>& jolt() const noexcept { return jolt_; }
  /// Of faces: index of the felt body to which they belong, or -1.
  [[nodiscard]] const Buffer<float>& whose() const noexcept { return whose_; }

 private:
  const MacFields& fields_;
  const GridSolids& solids_;
  Buffer<float> jolt_;
  Buffer<float> given_;  ///< of faces [m/s]
  Buffer<float> taken_;  ///< of faces [N s]
  Buffer<float> whose_;
  Buffer<float> parts_;  ///< sums of parts of the water and of the faces [N s, N m s]
  Kernel mark_faces_;
  Kernel weigh_faces_;
  Kernel weigh_given_;
  Kernel sum_given_;
};

}  // namespace splash::sim
