// SPDX-License-Identifier: MIT
// The grid that carries the weight, as it is laid into a tank, on the device, and the arrays that
// the stages of a step share.
#pragma once

#include <array>
#include <cstddef>

#include "sim-server/device/buffer.hpp"
#include "sim-server/device/kernel.hpp"
#include "sim-server/fluid/params/fluid_params.h"
#include "sim-server/fluid/pressure/grid_projected/mac_grid.h"

namespace splash::sim {

/// Edge of a cell, as nearly as whole numbers of them fill the tank [spacings].
inline constexpr double kMacCell = 2.0;

/// Between the walls, and upwards as far as the neighbour grid. Each level of the multigrid has
/// half the cells of the one before along each axis, down to one or two.
[[nodiscard]] MacGrid lay_mac_grid(const FluidParams& params);

/// Room for an array over all levels, and for vectors that are read past its end.
[[nodiscard]] std::size_t mac_room(const MacGrid& grid);

class Fluid;

struct MacFields {
  MacFields(Device& device, const FluidParams& params);

  /// For kernels: the fluid's parameters, and the grid.
  [[nodiscard]] std::array<KernelArg, 2> args(const Fluid& fluid) const;

  MacGrid grid;
  std::size_t cells;    ///< inside, and one more along each axis
  std::size_t vectors;  ///< of them and those around
  std::size_t room;     ///< of an array over all levels
  std::size_t team;     ///< work-items of a work-group that solves, or sums over bodies' cells

  Buffer<MacGrid> on_device;
  Buffer<float> mean;      ///< of the particles' velocities, on faces [m/s]
  Buffer<float> carries;   ///< that mean, sharpened: what carries particles [m/s]
  Buffer<float> weight;    ///< of the particles around a face [1]
  Buffer<float> fill;      ///< of cells [1]
  Buffer<float> change;    ///< by the step, on faces [m/s]
  Buffer<float> gain;      ///< the same, sharpened: what particles get [m/s]
  Buffer<float> pressure;  ///< of cells [Pa]
  Buffer<float> wet;       ///< 1 where a cell holds water
  Buffer<float> air;       ///< 1 where it holds air that is shut in
  Buffer<float> carried;   ///< what took particles along in the last step [m/s]
};

}  // namespace splash::sim
