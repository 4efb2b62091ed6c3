// SPDX-License-Identifier: MIT
// Divergence-free SPH (Bender & Koschier 2015, 2017): in every step pressures are found that first
// end all compression in the motion, then keep densities at rest. Both are relaxed Jacobi
// iterations with pressures of at least zero.
#pragma once

#include <array>
#include <vector>

#include "sim-server/device/buffer.hpp"
#include "sim-server/device/kernel.hpp"
#include "sim-server/fluid/pressure/divergence_free/solve_state.h"
#include "sim-server/fluid/pressure/pressure_solver.hpp"

namespace splash::sim {

class DivergenceFree : public PressureSolver {
 public:
  DivergenceFree(Device& device, const FluidParams& params,
                 const std::vector<std::string>& defines);

  void recall_pressure(Fluid& fluid, const Step& step) override;
  void accelerate(Fluid& fluid, const Step& step) override;
  [[nodiscard]] const Buffer<float>& response(const Fluid& /*fluid*/) const override {
    return response_;
  }
  void enqueue_work(Device& device) override;
  [[nodiscard]] SolverWork work() const override;
  void forget_work(Device& device) override;
  [[nodiscard]] std::vector<cl::Buffer> kept() const override {
    return {warm_.memory(), all_.memory()};
  }
  [[nodiscard]] std::vector<float> pressure(Device& device) override;
  void restore_pressure(Device& device, const std::vector<float>& pressure) override;

  // For tests, between steps.
  [[nodiscard]] const Buffer<float>& gradient() const noexcept { return gradient_; }
  [[nodiscard]] const Buffer<float>& response() const noexcept { return response_; }
  [[nodiscard]] const Buffer<float>& boundary_rate() const noexcept { return boundary_rate_; }

 private:
  void measure_response(Fluid& fluid, const Step& step);
  /// Iterates on `pressure` and the guessed velocities; the solve's number counts its work.
  void solve(Fluid& fluid, const Step& step, std::size_t number, const Buffer<float>& pressure);
  /// To gravity, to what rubs and to the pressures that the acceleration holds.
  void answer_of_bodies(Fluid& fluid, const Step& step);

  std::size_t particles_;
  std::size_t groups_;
  std::size_t stride_;
  std::size_t error_parts_ = 0;  ///< found in a correction, to be judged

  Buffer<float> gradient_;             ///< G
  Buffer<float> response_;             ///< D
  Buffer<float> boundary_rate_;        ///< of density, by moving bodies and piston [kg/m3 s]
  Buffer<float> guess_;                ///< velocities so far [m/s]
  Buffer<float> offset_;               ///< [kg/m3]
  Buffer<float> divergence_pressure_;  ///< p / rho^2, as all pressures here
  Buffer<float> jacobi_;               ///< pressures before momentum is added
  Buffer<float> change_;
  Buffer<float> warm_;  ///< by id: what the next density solve starts from
  Buffer<float> all_;   ///< by id: all that pushed in the last step
  Buffer<float> error_part_;

  static constexpr std::size_t kDivergence = 0;
  static constexpr std::size_t kDensity = 1;
  std::array<Buffer<SolveState>, 2> state_;
  std::array<std::array<SolveState, 1>, 2> state_read_;

  Kernel recall_pressure_;
  Kernel measure_response_;
  Kernel begin_divergence_solve_;
  Kernel begin_density_solve_;
  Kernel correct_pressure_;
  Kernel judge_solve_;
  Kernel push_by_pressure_;
  Kernel end_solves_;
};

}  // namespace splash::sim
