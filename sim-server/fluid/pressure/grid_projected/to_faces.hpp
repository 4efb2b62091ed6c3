// SPDX-License-Identifier: MIT
// Values of particles to the grid's faces: on CPUs by scatter.cl, on GPUs by gather.cl.
#pragma once

#include <cstddef>

#include "sim-server/device/buffer.hpp"
#include "sim-server/device/kernel.hpp"
#include "sim-server/fluid/pressure/grid_projected/mac_fields.hpp"

namespace splash::sim {

class Fluid;

class ToFaces {
 public:
  /// `fields` outlives it.
  ToFaces(Device& device, const cl::Program& program, const MacFields& fields);

  /// Finds the mean of `value`, x, y and z of each sorted particle, around each face; the weights
  /// of faces and the fill of cells in `fields`, too.
  void find(Fluid& fluid, const Buffer<float>& value, const Buffer<float>& mean);

 private:
  const MacFields& fields_;
  std::size_t items_;    ///< work-items that scatter; 0: one work-item for each cell gathers
  Buffer<float> grids_;  ///< a grid for each of these items
  Buffer<int> layers_;   ///< first and last layer that each of them reached
  Kernel gather_;
  Kernel scatter_;
  Kernel add_up_;
};

}  // namespace splash::sim
