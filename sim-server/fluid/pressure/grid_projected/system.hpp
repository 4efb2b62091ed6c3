// SPDX-License-Identifier: MIT
// The system that gives the pressures of a step (system.cl), its solution (solve.cl), and what that
// does to the velocities on faces (project.cl).
#pragma once

#include <array>

#include "sim-server/device/buffer.hpp"
#include "sim-server/device/kernel.hpp"
#include "sim-server/fluid/pressure/grid_projected/air_pockets.hpp"
#include "sim-server/fluid/pressure/grid_projected/coupling.hpp"
#include "sim-server/fluid/pressure/grid_projected/mac_fields.hpp"
#include "sim-server/fluid/pressure/grid_projected/mac_grid.h"
#include "sim-server/fluid/pressure/grid_projected/solids.hpp"
#include "sim-server/fluid/pressure/pressure_solver.hpp"

namespace splash::sim {

class PressureSystem {
 public:
  PressureSystem(Device& device, const cl::Program& program, const MacFields& fields,
                 const GridSolids& solids, const CoupledBodies& bodies, const ShutInAir& air);

  /// Adds gravity and viscosity to the velocities on faces.
  void push_faces(Fluid& fluid, const Step& step);
  void lay(Fluid& fluid, const Step& step);
  void solve(Fluid& fluid, const Step& step) {
    solve(fluid, step, true, kIterations, true, found_, state_);
  }
  /// Solves the system of the last solve with another right side in unknowns(), in at most so many
  /// `iterations`. `found` holds the first guess and then the solution. `yielding`: free bodies
  /// give way to the pressures.
  void solve_again(Fluid& fluid, const Step& step, int iterations, bool yielding,
                   const Buffer<float>& found, const Buffer<SolveState>& state) {
    solve(fluid, step, false, iterations, yielding, found, state);
  }
  void project(Fluid& fluid, const Step& step);
  /// Turns changes of velocity on faces at the surface into those that the particles there get.
  void share_at_surface(Device& device, const Buffer<float>& field);
  /// Undoes in `sharp` what the hats take of a field on faces in the water. Faces with different
  /// numbers in `parts`, if there are any, exchange nothing.
  void sharpen(Device& device, const Buffer<float>& field, const Buffer<float>& sharp,
               const Buffer<float>* parts);

  /// The last solution: pressure times the step's length over the density [m2/s].
  [[nodiscard]] const Buffer<float>& found() const noexcept { return found_; }
  /// The arrays that a solve begins from, as kernel arguments; `open`: what the surface adds to the
  /// equations of cells, and after a solve their diagonals.
  [[nodiscard]] std::array<KernelArg, 5> unknowns() const {
    return {{{"open", open_}, {"x", x_}, {"right", b_}, {"rest", r_}, {"way", way_}}};
  }

  void enqueue_work(Device& device) { state_.enqueue_read(device, state_read_); }
  [[nodiscard]] SolveWork work() const;
  void forget_work(Device& device);
  /// Clears what a failed step left, which later steps would begin from.
  void forget(Device& device);

 private:
  static constexpr int kIterations = 40;  ///< of a solve, at most

  void solve(Fluid& fluid, const Step& step, bool anew, int iterations, bool yielding,
             const Buffer<float>& found, const Buffer<SolveState>& state);

  const MacFields& fields_;
  const GridSolids& solids_;
  const CoupledBodies& bodies_;
  const ShutInAir& air_;
  Buffer<int> most_;

  // Over all levels; the last three over the finest.
  Buffer<float> link_;
  Buffer<float> open_;
  Buffer<float> damped_;
  Buffer<float> x_;
  Buffer<float> b_;
  Buffer<float> r_;
  Buffer<float> found_;
  Buffer<float> way_;
  Buffer<float> along_;

  Buffer<SolveState> state_;
  std::array<SolveState, 1> state_read_ = {};
  Kernel push_faces_;
  Kernel lay_system_;
  Kernel solve_pressure_;
  Kernel project_faces_;
  Kernel share_at_surface_;
  Kernel sharpen_faces_;
};

}  // namespace splash::sim
