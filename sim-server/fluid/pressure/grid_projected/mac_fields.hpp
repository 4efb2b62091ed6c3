// SPDX-License-Identifier: MIT
// The grid on the device, with the arrays that the stages of a step share.
#pragma once

#include <cstddef>

#include "sim-server/device/buffer.hpp"
#include "sim-server/fluid/pressure/grid_projected/mac_layout.hpp"

namespace splash::sim {

struct MacFields {
  MacFields(Device& device, const FluidParams& params);

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
