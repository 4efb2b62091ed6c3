// SPDX-License-Identifier: MIT
// Grid-projected SPH (after Raveendran, Wojtan & Turk 2011): in every step a coarse grid finds the
// pressures that keep the water's volume, weight and all, and gives the particles what these change
// of their velocities. Sums over neighbours keep the particles' spacing, as a displacement.
// README.md has the scheme.
#pragma once

#include <array>
#include <optional>
#include <vector>

#include "sim-server/device/buffer.hpp"
#include "sim-server/device/kernel.hpp"
#include "sim-server/fluid/pressure/grid_projected/mac_layout.hpp"
#include "sim-server/fluid/pressure/grid_projected/solve_state.h"
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

class GridProjected : public PressureSolver {
 public:
  /// `solids`: the scene may have bodies, a slope or a wave maker.
  GridProjected(Device& device, const FluidParams& params, const std::vector<std::string>& defines,
                bool solids);

  void release(Device& device, std::size_t count) override;
  /// Where a step follows nobody asks: pressure_term() stays the state equation's, for spacing.
  void recall_pressure(Fluid& fluid, const Step& step) override;
  void accelerate(Fluid& fluid, const Step& step) override;
  void move(Fluid& fluid, const Step& step) override;
  [[nodiscard]] const Buffer<float>& carried(const Fluid& fluid) const override;
  [[nodiscard]] std::vector<Press> press(Device& device, std::size_t bodies) override;
  [[nodiscard]] bool has_pushes() const override { return true; }
  void feel(Device& device, bool on) override;
  void add_pushes(Fluid& fluid, const Step& step, const FeltBodies& felt) override;
  void enqueue_work(Device& device) override;
  [[nodiscard]] SolveWork work() const override;
  void forget_work(Device& device) override;
  [[nodiscard]] std::vector<cl::Buffer> kept() const override {
    return {pressure_.memory(), wet_.memory(), stopped_.memory()};
  }
  void forget_pressure(Device& device) override;
  void note_recalled(Device& device) override;

  // For tests, between steps.
  [[nodiscard]] const MacGrid& grid() const noexcept { return grid_; }
  [[nodiscard]] const Buffer<float>& mean() const noexcept { return mean_; }
  [[nodiscard]] const Buffer<float>& weight() const noexcept { return weight_; }
  [[nodiscard]] const Buffer<float>& fill() const noexcept { return solids_ ? filled_ : fill_; }
  [[nodiscard]] const Buffer<float>& deviation() const noexcept { return deviation_; }
  [[nodiscard]] const Buffer<float>& seen() const noexcept { return seen_; }
  [[nodiscard]] const Buffer<float>& change() const noexcept { return change_; }
  [[nodiscard]] const Buffer<float>& pressures() const noexcept { return pressure_; }
  [[nodiscard]] const Buffer<float>& gap() const noexcept { return gap_; }
  [[nodiscard]] const Buffer<float>& space() const noexcept { return space_; }

 private:
  /// What they leave open of the grid.
  void place_solids(Fluid& fluid, const Step& step);
  /// Free bodies as they would be without water.
  void let_fall(Fluid& fluid, const Step& step);
  void solve(Fluid& fluid, const Step& step);
  /// Of the system as it is laid, from what is in `found` to its solution there.
  void run_solve(Fluid& fluid, const Step& step, int iterations, const Buffer<float>& found,
                 const Buffer<SolveState>& state);
  /// What the water does to them.
  void push_bodies(Fluid& fluid, const Step& step);
  /// What the water did to felt bodies in this step.
  void weigh_felt(Fluid& fluid, const Step& step);
  /// What they gave it beyond the pressures `found`; of one of them, with the answer to a part of
  /// its speed, or of all (-1).
  void weigh_given(Fluid& fluid, const Step& step, const Buffer<float>& found, int only, int part);
  /// Whether any hangs on a device.
  [[nodiscard]] bool has_hung(Fluid& fluid) const;
  /// Those of the water, none before it lets them go.
  [[nodiscard]] int free_count(Fluid& fluid) const;
  [[nodiscard]] const Buffer<FreeBody>& frees(Fluid& fluid) const;
  /// The same with what their springs add to their inertia.
  [[nodiscard]] const Buffer<FreeBody>& solved_frees(Fluid& fluid) const;

  MacGrid grid_;
  double part_;  ///< of the default step's length, by the scene's factor [1]
  std::size_t particles_;
  std::size_t cells_;    ///< inside, and one more along each axis
  std::size_t strips_;   ///< of these that are gathered for together
  std::size_t vectors_;  ///< of them and those around
  std::size_t room_;

  Buffer<MacGrid> grid_buffer_;
  Buffer<float> mean_;       ///< of the particles' velocities, on faces [m/s]
  Buffer<float> weight_;     ///< of the particles around a face [1]
  Buffer<float> fill_;       ///< of cells [1]
  Buffer<float> deviation_;  ///< of particles [m/s]
  Buffer<float> seen_;       ///< its mean on faces [m/s]
  Buffer<float> change_;     ///< by the step, on faces [m/s]
  Buffer<float> carried_;    ///< what took particles along in the last step [m/s]
  Buffer<float> pressure_;   ///< of cells [Pa]
  Buffer<float> wet_;        ///< 1 where a cell holds water
  Buffer<int> most_;

  // Of solids; of one element where there are none (solids.cl).
  bool solids_;
  Buffer<float> gap_;         ///< open part around faces [1]
  Buffer<float> upper_;       ///< of the upper half of cells along each axis [1]
  Buffer<float> space_;       ///< of cells [1]
  Buffer<int> owner_;         ///< whose a cell is (room.h)
  Buffer<float> seen_space_;  ///< open part of what a cell's hat sees [1]
  Buffer<float> filled_;      ///< of cells, by their open part [1]

  // Of free bodies (coupling.h), once there are some.
  Buffer<FreeBody> no_body_;
  Buffer<float> grip_;
  Buffer<float> stopped_;
  Buffer<FreeBody> tied_;  ///< as heavy as springs make them (hang.cl)
  Buffer<float> tuggings_;

  // Of bodies that are felt (felt.cl), once there are some.
  bool feels_ = false;
  Buffer<float> felt_grip_;
  Buffer<float> surface_;  ///< open_ before a solve
  Buffer<float> answer_;
  Buffer<SolveState> answer_state_;

  // For the momentum that felt bodies give the particles (given.cl).
  Buffer<float> jolt_;   ///< of particles [m/s]
  Buffer<float> given_;  ///< of faces [m/s]
  Buffer<float> taken_;  ///< of faces [N s]
  Buffer<float> whose_;  ///< of faces: index of the felt body, or -1
  Buffer<float> parts_;  ///< sums of parts of the water and of the faces [N s, N m s]
  std::optional<FeltBodies> felt_now_;  ///< of this step, until it has moved the particles

  // The solve's, over all levels; the last three over the finest.
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
  std::array<SolveState, 1> state_read_;

  Kernel gather_faces_;
  Kernel gather_again_;
  Kernel find_deviation_;
  Kernel cut_cells_;
  Kernel open_faces_;
  Kernel fill_beside_solids_;
  Kernel let_fall_;
  Kernel grip_water_;
  Kernel push_bodies_;
  Kernel tie_bodies_;
  Kernel tell_tugs_;
  Kernel weigh_pressure_;
  Kernel ask_for_answer_;
  Kernel weigh_answer_;
  Kernel mark_faces_;
  Kernel weigh_faces_;
  Kernel weigh_given_;
  Kernel sum_given_;
  Kernel push_faces_;
  Kernel lay_system_;
  Kernel solve_pressure_;
  Kernel project_faces_;
  Kernel find_spacing_;
  Kernel move_particles_;
  Kernel sample_pressure_;
};

}  // namespace splash::sim
