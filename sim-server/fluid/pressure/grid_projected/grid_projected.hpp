// SPDX-License-Identifier: MIT
// Grid-projected SPH (after Raveendran, Wojtan & Turk 2011): in every step a coarse grid finds the
// pressures that keep the water's volume, weight and all, and gives the particles what these change
// of their velocities. Sums over neighbours keep the particles' spacing, as a displacement.
// README.md has the scheme.
#pragma once

#include <string>
#include <vector>

#include "sim-server/device/buffer.hpp"
#include "sim-server/device/kernel.hpp"
#include "sim-server/fluid/pressure/grid_projected/air_pockets.hpp"
#include "sim-server/fluid/pressure/grid_projected/coupling.hpp"
#include "sim-server/fluid/pressure/grid_projected/crowding.hpp"
#include "sim-server/fluid/pressure/grid_projected/felt.hpp"
#include "sim-server/fluid/pressure/grid_projected/mac_fields.hpp"
#include "sim-server/fluid/pressure/grid_projected/solids.hpp"
#include "sim-server/fluid/pressure/grid_projected/system.hpp"
#include "sim-server/fluid/pressure/grid_projected/to_faces.hpp"
#include "sim-server/fluid/pressure/pressure_solver.hpp"

namespace splash::sim {

/// In a step nothing goes farther than this [spacings].
inline constexpr double kGridAdvectiveCfl = 1.0;
/// However much longer a scene asks steps to be, nothing goes this much farther [1].
inline constexpr double kLargestGridCfl = 1.05;

/// What the second-order filter takes of the velocities that the grid does not see: half the
/// frequency of a wave 2 pi spacings long, sqrt(g / dx), with the earth's g whatever the scene's
/// [1/s].
[[nodiscard]] double filter_rate(double spacing);

/// Spacing in a step of the default length: how far its sound goes [supports], and what part of its
/// push stays as speed [1]. In shorter ones both count by the time that they take.
inline constexpr double kSpacingWay = 0.25;
inline constexpr double kSpacingKick = 0.05;
/// Particles away from bodies are pushed apart in one of so many steps, by as much as all of these
/// steps would push them [1].
inline constexpr int kSpacingSteps = 2;

class GridProjected : public PressureSolver {
 public:
  /// `solids`: the scene may have bodies, a slope or a wave maker.
  GridProjected(Device& device, const FluidParams& params, const std::vector<std::string>& defines,
                bool solids);

  void release(Device& device, std::size_t count) override { bodies_.release(device, count); }
  [[nodiscard]] bool needs_density() const override { return spaces(); }
  /// Where a step follows nobody asks: pressure_term() stays the state equation's, for spacing.
  void recall_pressure(Fluid& fluid, const Step& step) override;
  void accelerate(Fluid& fluid, const Step& step) override;
  void move(Fluid& fluid, const Step& step) override;
  [[nodiscard]] const Buffer<float>& carried(const Fluid& fluid) const override;
  [[nodiscard]] bool has_pushes() const override { return true; }
  void feel(Device& device, bool on) override { felt_.feel(device, on); }
  void add_pushes(Fluid& /*fluid*/, const Step& /*step*/, const FeltBodies& felt) override {
    felt_.add(felt);
  }
  void enqueue_work(Device& device) override { system_.enqueue_work(device); }
  [[nodiscard]] SolveWork work() const override { return system_.work(); }
  void forget_work(Device& device) override { system_.forget_work(device); }
  [[nodiscard]] std::vector<cl::Buffer> kept() const override {
    std::vector<cl::Buffer> all = {fields_.pressure.memory(), fields_.wet.memory()};
    for (const std::vector<cl::Buffer>& more : {solids_.kept(), air_.kept(), bodies_.kept()}) {
      all.insert(all.end(), more.begin(), more.end());
    }
    return all;
  }
  void forget_pressure(Device& device) override;
  void note_recalled(Device& device) override;

  // For tests, between steps.
  [[nodiscard]] const MacFields& fields() const noexcept { return fields_; }
  [[nodiscard]] const GridSolids& solids() const noexcept { return solids_; }
  [[nodiscard]] const ShutInAir& air() const noexcept { return air_; }
  [[nodiscard]] const FeltForces& felt() const noexcept { return felt_; }
  [[nodiscard]] const Crowding& crowding() const noexcept { return crowding_; }
  [[nodiscard]] const Buffer<float>& deviation() const noexcept { return deviation_; }
  [[nodiscard]] const Buffer<float>& seen() const noexcept { return seen_; }

 private:
  GridProjected(Device& device, const FluidParams& params, const cl::Program& program, bool solids);

  /// True if this step pushes all particles apart, false if only those beside bodies. Between
  /// steps: of the next step.
  [[nodiscard]] bool spaces() const noexcept { return since_spacing_ == 0; }

  int since_spacing_ = 0;  ///< steps, modulo kSpacingSteps
  double part_;            ///< of the default step's length, by the scene's factor [1]
  MacFields fields_;
  GridSolids solids_;
  ShutInAir air_;
  CoupledBodies bodies_;
  PressureSystem system_;
  FeltForces felt_;
  Crowding crowding_;
  ToFaces to_faces_;
  Buffer<float> deviation_;  ///< of particles [m/s]
  Buffer<float> seen_;       ///< its mean on faces [m/s]
  Kernel find_deviation_;
  Kernel find_spacing_;
  Kernel move_particles_;
  Kernel sample_pressure_;
};

}  // namespace splash::sim
