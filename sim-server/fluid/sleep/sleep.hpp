// SPDX-License-Identifier: MIT
// Which cells of the fluid are awake (sleep/sleep.h says what that means), and which groups of
// particles a step has no work for (sleep/rest.h).
#pragma once

#include "sim-server/device/buffer.hpp"
#include "sim-server/device/kernel.hpp"
#include "sim-server/fluid/neighbours/neighbour_grid.hpp"
#include "sim-server/fluid/params/fluid_params.h"

namespace splash::sim {

/// When water may sleep.
struct SleepRule {
  double speed = 0.0;  ///< slower water may sleep [m/s]; 0: none ever does
  int frames = 1;      ///< after that many frames in a row
};

class Sleep {
 public:
  Sleep() = default;
  /// All cells are awake.
  Sleep(Device& device, const cl::Program& program, const FluidParams& params);

  void set_rule(const SleepRule& rule) noexcept { rule_ = rule; }
  [[nodiscard]] bool allowed() const noexcept { return rule_.speed > 0.0; }

  /// Once a frame, after the particles have been sorted. `bodies`: entries of all its steps;
  /// `piston_moves`: the wave maker wakes the cells in its reach, up to its `piston` [m].
  void update(cl::CommandQueue& queue, const FluidParams& params,
              const Buffer<FluidParams>& params_buffer, const NeighbourGrid& grid,
              const Buffer<float>& velocity, const Buffer<BodyStep>& bodies, int body_count,
              bool piston_moves, double piston);
  /// Wakes everything.
  void wake(Device& device);

  /// Of each cell, what goes on in it (params/fluid_params.h).
  [[nodiscard]] const Buffer<int>& activity() const noexcept { return activity_; }
  /// Of each group of particles, for how many steps it has rested (sleep/rest.h).
  [[nodiscard]] const Buffer<int>& resting() const noexcept { return resting_; }

 private:
  void over_rows(Kernel& kernel, cl::CommandQueue& queue,
                 std::initializer_list<KernelArg> args) const {
    if (by_teams_) {
      kernel.run_teams(queue, rows_, args);
    } else {
      kernel.run(queue, rows_, args);
    }
  }

  SleepRule rule_;
  std::size_t rows_ = 0;
  Buffer<int> awake_;  ///< frames that each cell stays awake, 0: asleep
  Buffer<int> activity_;
  Buffer<int> resting_;
  bool by_teams_ = false;  ///< that share a row of cells
  Kernel keep_awake_;
  Kernel spread_activity_;
};

}  // namespace splash::sim
