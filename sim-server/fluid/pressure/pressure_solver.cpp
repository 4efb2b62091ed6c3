// SPDX-License-Identifier: MIT
#include "sim-server/fluid/pressure/pressure_solver.hpp"

#include "sim-server/fluid/fluid.hpp"
#include "sim-server/fluid/pressure/grid_projected/grid_projected.hpp"

namespace splash::sim {
namespace {

/// Pressure by the state equation: the density kernel has it already, and nothing is kept.
class WeaklyCompressible : public PressureSolver {
 public:
  void recall_pressure(Fluid& /*fluid*/, const Step& /*step*/) override {}
  void accelerate(Fluid& fluid, const Step& step) override {
    fluid.compute_acceleration(step);
    if (FreeBodies* bodies = fluid.free_bodies()) bodies->answer(fluid, step);
  }
  void enqueue_work(Device& /*device*/) override {}
  [[nodiscard]] SolveWork work() const override { return {}; }
  void forget_work(Device& /*device*/) override {}
  [[nodiscard]] std::vector<cl::Buffer> kept() const override { return {}; }
};

}  // namespace

void PressureSolver::move(Fluid& fluid, const Step& step) {
  fluid.integrate(step);
}

const Buffer<float>& PressureSolver::carried(const Fluid& fluid) const {
  return fluid.particles().velocity;
}

std::unique_ptr<PressureSolver> make_pressure_solver(Device& device, const FluidParams& params,
                                                     const std::vector<std::string>& defines,
                                                     bool solids) {
  if (params.solver == SPLASH_GRID_PROJECTED) {
    return std::make_unique<GridProjected>(device, params, defines, solids);
  }
  return std::make_unique<WeaklyCompressible>();
}

}  // namespace splash::sim
