// SPDX-License-Identifier: MIT
// The momentum that felt bodies give the particles beyond the grid's pressures on them (given.cl).
#pragma once

#include "sim-server/device/buffer.hpp"
#include "sim-server/device/kernel.hpp"
#include "sim-server/fluid/pressure/grid_projected/mac_fields.hpp"
#include "sim-server/fluid/pressure/grid_projected/solids.hpp"
#include "sim-server/fluid/pressure/grid_projected/system.hpp"
#include "sim-server/fluid/pressure/pressure_solver.hpp"

namespace splash::sim {

class GivenMomentum {
 public:
  GivenMomentum(Device& device, const cl::Program& program, const MacFields& fields,
                const GridSolids& solids, PressureSystem& system);

  /// Allocates the arrays. Called before the first step in which a body is felt.
  void make_room(Device& device);
  /// Subtracts from the sums of `felt` the momentum that the bodies gave the particles beyond the
  /// pressures `found`. With `only`, the index of one body, adds instead the derivative by
  /// component `part` of its speed, for which `found` is the derivative of the pressures; or, with
  /// SPLASH_BY_FLOW, subtracts what the particles far from all felt bodies got beyond the pressures
  /// that answer its flow. The particles have moved.
  void weigh(Fluid& fluid, const Step& step, const FeltBodies& felt, const Buffer<float>& found,
             int only = -1, int part = 0);

  /// Of each particle, the change of velocity by bodies other than by the grid's pressure, which
  /// find_spacing and move_particles write [m/s].
  [[nodiscard]] const Buffer<float>& jolt() const noexcept { return jolt_; }
  /// For each face, the index of the felt body whose force the last weigh() attributed it to, or
  /// -1.
  [[nodiscard]] const Buffer<float>& whose() const noexcept { return whose_; }
  /// For each face, what the last weigh() used: the change of velocity that particles get [m/s],
  /// and the momentum of the pressures [N s].
  [[nodiscard]] const Buffer<float>& given() const noexcept { return given_; }
  [[nodiscard]] const Buffer<float>& taken() const noexcept { return taken_; }

 private:
  const MacFields& fields_;
  const GridSolids& solids_;
  PressureSystem& system_;
  Buffer<float> jolt_;
  Buffer<float> change_;  ///< of faces [m/s]
  Buffer<float> given_;   ///< the same, sharpened: what particles get [m/s]
  Buffer<float> taken_;   ///< of faces [N s]
  Buffer<float> whose_;
  Buffer<float> parts_;  ///< sums of parts of the water and of the faces [N s, N m s]
  Kernel mark_faces_;
  Kernel weigh_faces_;
  Kernel weigh_given_;
  Kernel sum_given_;
};

}  // namespace splash::sim
