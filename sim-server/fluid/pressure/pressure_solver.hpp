// SPDX-License-Identifier: MIT
// Where the water's pressure comes from: a state equation, whose pair forces push
// (pressure/acceleration.cl), or the demand that nothing compresses, made of a grid.
#pragma once

#include <cstdint>
#include <memory>
#include <string>
#include <vector>

#include "sim-server/device/buffer.hpp"
#include "sim-server/device/device.hpp"
#include "sim-server/fluid/params/fluid_params.h"
#include "sim-server/fluid/time_step.hpp"
#include "sim-server/scene/scene.hpp"

namespace splash::sim {

class Fluid;

/// Totals over all solves since counting began; zero with a solver that does not iterate.
struct SolveWork {
  std::int64_t solves = 0;
  std::int64_t iterations = 0;  ///< of all solves
  int most = 0;                 ///< of one solve
  std::int64_t given_up = 0;    ///< solves that ended with more than the allowed error
  double error = 0.0;           ///< what the last solve left of the demand [1]
};

/// Bodies that go their own way, and what is summed of the water's push on each
/// (free_bodies/body_pushes.hpp).
struct FeltBodies {
  const std::vector<FreeBody>& list;
  const Buffer<FreeBody>& on_device;
  const std::vector<bool>& wanted;  ///< of each, whether its derivative by speed is, too
  const Buffer<float>& sums;        ///< twelve of each
};

class PressureSolver {
 public:
  PressureSolver() = default;
  PressureSolver(const PressureSolver&) = delete;
  PressureSolver& operator=(const PressureSolver&) = delete;
  virtual ~PressureSolver() = default;

  /// From now on the water moves so many bodies.
  virtual void release(Device& /*device*/, std::size_t /*count*/) {}
  /// True if the next step needs the densities of all particles. If not, those beside bodies get a
  /// new density and all others keep theirs.
  [[nodiscard]] virtual bool needs_density() const { return true; }
  /// After density: leaves in Fluid::pressure_term() what is known before the step is solved, or,
  /// where its length is 0, for whoever wants to read it.
  virtual void recall_pressure(Fluid& fluid, const Step& step) = 0;
  /// Fills Fluid::acceleration(), and pressure_term() with what pushed.
  virtual void accelerate(Fluid& fluid, const Step& step) = 0;
  /// Then the state moves on by step.dt: as the acceleration says, unless the solver knows better.
  virtual void move(Fluid& fluid, const Step& step);
  /// The velocities that took the particles where the last step left them [m/s].
  [[nodiscard]] virtual const Buffer<float>& carried(const Fluid& fluid) const;

  /// Whether bodies feel pressures of the solver's own and not the particles': those are added by
  /// add_pushes.
  [[nodiscard]] virtual bool has_pushes() const { return false; }
  /// From the next step on somebody feels them, or nobody does.
  virtual void feel(Device& /*device*/, bool /*on*/) {}
  /// Between accelerate and move of such a step. The buffers of `felt` must exist until move has
  /// been called.
  virtual void add_pushes(Fluid& /*fluid*/, const Step& /*step*/, const FeltBodies& /*felt*/) {}

  /// Enqueues the read of the work done; work() tells it once the queue is finished.
  virtual void enqueue_work(Device& device) = 0;
  [[nodiscard]] virtual SolveWork work() const = 0;
  /// Counting begins anew.
  virtual void forget_work(Device& device) = 0;

  /// What is kept from step to step, where it is on the device.
  [[nodiscard]] virtual std::vector<cl::Buffer> kept() const = 0;
  /// The water was put elsewhere: the next solve begins from no pressure.
  virtual void forget_pressure(Device& /*device*/) {}
  /// What is kept was put back as it was before a step that went wrong.
  virtual void note_recalled(Device& /*device*/) {}
};

/// The one that `params` ask for, its kernels built with `defines`; `solids`: the scene may have
/// bodies, a slope or a wave maker.
[[nodiscard]] std::unique_ptr<PressureSolver> make_pressure_solver(
    Device& device, const FluidParams& params, const std::vector<std::string>& defines,
    bool solids);

}  // namespace splash::sim
