// SPDX-License-Identifier: MIT
// The water: its particles on the device and the stages of a time step.
#pragma once

#include <memory>
#include <vector>

#include "sim-server/device/buffer.hpp"
#include "sim-server/device/kernel.hpp"
#include "sim-server/fluid/boundary/boundary.hpp"
#include "sim-server/fluid/free_bodies/free_bodies.hpp"
#include "sim-server/fluid/health/health.hpp"
#include "sim-server/fluid/health/health_record.h"
#include "sim-server/fluid/neighbours/neighbour_grid.hpp"
#include "sim-server/fluid/params/boundary_point.hpp"
#include "sim-server/fluid/params/fluid_params.h"
#include "sim-server/fluid/params/parts.hpp"
#include "sim-server/fluid/pressure/pressure_solver.hpp"
#include "sim-server/fluid/pressure/tank_turn.hpp"
#include "sim-server/fluid/sleep/sleep.hpp"
#include "sim-server/fluid/time_step.hpp"
#include "sim-server/scene/rotation.hpp"

namespace splash::sim {

/// How kernels are built.
struct KernelBuild {
  bool whole = whole_asked();  ///< with parts that the scene does not need, too (parts.hpp)
};

/// Health and limits of the whole fluid.
struct FluidStats {
  double speed = 0.0;         ///< fastest particle [m/s]
  double acceleration = 0.0;  ///< largest [m/s2]
  double mean_excess = 0.0;   ///< mean of max(rho / rho0 - 1, 0) [1]
  double max_excess = 0.0;
  int not_finite = 0;               ///< particles that are no numbers any more
  int first_bad = -1;               ///< smallest id of such a particle, -1: none
  int runaway = 0;                  ///< particles at the speed limit
  int asleep = 0;                   ///< particles that did not take part in the last step
  Vector3 lower = {0.0, 0.0, 0.0};  ///< box around all particles [m]
  Vector3 upper = {0.0, 0.0, 0.0};
};

/// A copy of the state that can be put back.
struct Snapshot {
  std::vector<float> position;
  std::vector<float> velocity;
  std::vector<int> id;
  std::vector<float> peak_density;  ///< densest since torn (pressure/state_equation.h) [kg/m3]

  /// The place of number `i` [m].
  [[nodiscard]] Vector3 place(std::size_t i) const {
    return vector_at(position, position.size() / 3, i);
  }
};

/// Everything is enqueued on the device's in-order queue; only stats, snapshot and restore wait
/// for it.
class Fluid {
 public:
  /// `particles`: initial places [m]; `boundary`: points of the rigid bodies, `outlines`: theirs,
  /// which nothing is caught in.
  /// `build`: how its kernels are built.
  Fluid(Device& device, const FluidParams& params, const std::vector<Vector3>& particles,
        const std::vector<BoundaryPoint>& boundary, const Outlines& outlines,
        const KernelBuild& build = {});

  /// Bodies of all steps of the coming frame, step after step.
  void set_bodies(const std::vector<BodyStep>& steps);

  /// From now on the water moves these of its bodies; until then they go where set_bodies says.
  /// set_bodies then says where they begin a frame. At least one; `skin`: of them; `pairs`: whose
  /// friction is one of their own. Waits.
  void release(const std::vector<FreeBody>& bodies, const std::vector<SkinFace>& skin,
               const std::vector<PairFriction>& pairs = {});
  /// Null while no body is free.
  [[nodiscard]] FreeBodies* free_bodies() noexcept { return free_.get(); }

  /// First half of a step: neighbours and density, for the state before it.
  void prepare(const Step& step);
  /// Second half: forces, and the state moves on by step.dt.
  void advance(const Step& step) {
    accelerate(step);
    move(step);
  }
  /// Its parts. In between pressure_term() has all that pushes in this step.
  void accelerate(const Step& step);
  void move(const Step& step);

  /// From now on water at rest may sleep: steps that open a frame say when that is looked at.
  void let_sleep(const SleepRule& rule);
  /// No steps follow for a while: moving() says of all particles that they sleep.
  void note_asleep() { moving_.enqueue_clear(device_); }

  /// A frame of so many steps begins: from now on the health of each is looked at
  /// (Health::diagnosis, once the statistics is there).
  void begin_watch(std::size_t steps);
  void end_watch() noexcept { watched_ = false; }
  [[nodiscard]] Health& health() noexcept { return health_; }
  /// All that the next step depends on, for checkpoints.
  [[nodiscard]] std::vector<cl::Buffer> state() const;
  /// A checkpoint was put back: all that slept is awake.
  void note_recalled();

  /// How the tank moves in the coming steps, of `dt` [s] each: gravity in its axes and, if it
  /// `turns`, what that does to the water.
  void set_tank(const TankState& tank, const Vector3& pivot, bool turns, double dt);

  /// Stops all particles where they are.
  void zero_velocities();
  /// Until enable_gravity nothing acts on the water from afar, neither gravity nor the central
  /// field, and it does not pull. Both wait.
  void disable_gravity();
  void enable_gravity();

  /// Enqueues the statistics; its result is there once the queue is finished.
  void enqueue_stats();
  [[nodiscard]] FluidStats stats_result() const;
  /// Both, and waits.
  [[nodiscard]] FluidStats stats();
  [[nodiscard]] Snapshot snapshot();
  void restore(const Snapshot& snapshot);

  /// What PressureSolver says of these.
  void feel(bool on) { solver_->feel(device_, on); }
  void add_pushes(const Step& step, const FeltBodies& felt) {
    solver_->add_pushes(*this, step, felt);
  }

  /// For solvers: accelerations from the present pressure_term() and velocities.
  void compute_acceleration(const Step& step);
  /// Moves the state on as the accelerations say.
  void integrate(const Step& step);
  /// Length of the last step [s].
  [[nodiscard]] double last_step() const noexcept { return last_step_; }
  /// Work-items of the stages that handle a vector of particles at once.
  [[nodiscard]] std::size_t groups() const;
  [[nodiscard]] const PressureSolver& solver() const noexcept { return *solver_; }
  /// Work of the pressure solver until the last statistics, without what was before forget_work.
  [[nodiscard]] SolveWork solver_work() const { return solver_->work(); }
  void forget_work() { solver_->forget_work(device_); }

  // What detectors read between prepare and advance.
  [[nodiscard]] Device& device() noexcept { return device_; }
  [[nodiscard]] const FluidParams& params() const noexcept { return params_; }
  [[nodiscard]] const KernelParts& parts() const noexcept { return parts_; }
  [[nodiscard]] const Buffer<FluidParams>& params_buffer() const noexcept { return params_buffer_; }
  [[nodiscard]] const PointArrays& particles() const noexcept { return sorted_; }
  /// As they were before the step and its sort: grid().source() says where each was.
  [[nodiscard]] const PointArrays& particles_before() const noexcept { return unsorted_; }
  [[nodiscard]] const NeighbourGrid& grid() const noexcept { return grid_; }
  /// What goes on in each cell (sleep/sleep.h).
  [[nodiscard]] const Buffer<int>& cell_activity() const noexcept { return sleep_.activity(); }
  [[nodiscard]] const Buffer<float>& density() const noexcept { return density_; }
  [[nodiscard]] const Buffer<float>& water_density() const noexcept { return water_density_; }
  /// What boundary/body_image.h keeps of each particle near a body: R, its gradient and the nearest
  /// body, part after part; others have what an earlier step left.
  [[nodiscard]] const Buffer<float>& body_images() const noexcept { return body_images_; }
  [[nodiscard]] const Buffer<float>& peak_density() const noexcept { return peak_density_; }
  [[nodiscard]] const Buffer<float>& pressure_term() const noexcept { return pressure_term_; }
  [[nodiscard]] const Buffer<float>& acceleration() const noexcept { return acceleration_; }
  /// Of each particle: 0 if it slept through the last step.
  [[nodiscard]] const Buffer<int>& moving() const noexcept { return moving_; }
  [[nodiscard]] const Boundary& boundary() const noexcept { return boundary_; }

 private:
  void load_particles(const std::vector<Vector3>& particles, bool near_bodies);
  void build_kernels(const std::vector<BoundaryPoint>& boundary, const Outlines& outlines);
  void wake_and_sleep(const Step& step);
  void sort_particles();
  void compute_density(const Step& step);

  Device& device_;
  FluidParams params_;
  KernelParts parts_;

  Buffer<FluidParams> params_buffer_;
  PointArrays sorted_;    ///< the state, in cell order after prepare
  PointArrays unsorted_;  ///< the state before the sort
  Buffer<float> density_;
  Buffer<float> water_density_;  ///< without the bodies' part
  Buffer<float> peak_density_;   ///< densest since the water last came apart
  Buffer<float> pressure_term_;
  Buffer<float> body_images_;
  Buffer<float> acceleration_;
  Buffer<float> density_before_;  ///< of the step before, in its order
  Buffer<float> water_density_before_;
  Buffer<float> peak_density_before_;
  Buffer<int> moving_;  ///< 0: slept through the last step
  NeighbourGrid grid_;
  Sleep sleep_;
  Boundary boundary_;
  std::unique_ptr<PressureSolver> solver_;
  std::unique_ptr<FreeBodies> free_;
  std::unique_ptr<TankTurning> turning_;  ///< null: the tank does not turn

  Kernel compute_density_;
  Kernel compute_acceleration_;
  Kernel integrate_;
  Kernel stats_;
  Health health_;
  bool watched_ = false;
  double last_step_ = 0.0;  ///< [s]
  bool prepared_ = false;   ///< and not advanced since
  Buffer<FluidStatsPart> stats_parts_;
  std::vector<FluidStatsPart> stats_read_;
};

}  // namespace splash::sim
