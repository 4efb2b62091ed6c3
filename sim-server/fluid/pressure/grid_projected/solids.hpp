// SPDX-License-Identifier: MIT
// What bodies, slope and wave maker leave open of the grid (solids.cl, open_areas.cl).
#pragma once

#include <vector>

#include "sim-server/device/buffer.hpp"
#include "sim-server/device/kernel.hpp"
#include "sim-server/fluid/pressure/grid_projected/mac_fields.hpp"
#include "sim-server/fluid/pressure/pressure_solver.hpp"

namespace splash::sim {

class GridSolids {
 public:
  /// `any`: the scene may have some. Without, nothing is cut, and the arrays have one element.
  GridSolids(Device& device, const cl::Program& program, const MacFields& fields, bool any);

  /// What the next step needs of the last one.
  [[nodiscard]] std::vector<cl::Buffer> kept() const {
    if (!any_) return {};
    return {airless_.memory()};
  }
  void forget(Device& device) { airless_.enqueue_clear(device); }

  /// Cuts the grid by the solids where they are in this step.
  void place(Fluid& fluid, const Step& step);

  [[nodiscard]] bool any() const noexcept { return any_; }
  /// How full cells are, of their open part [1].
  [[nodiscard]] const Buffer<float>& fill() const noexcept { return any_ ? filled_ : fields_.fill; }
  /// Open part of what a cell's hat sees [1].
  [[nodiscard]] const Buffer<float>& seen() const noexcept { return seen_space_; }
  [[nodiscard]] const Buffer<float>& gap() const noexcept { return gap_; }
  /// Part of the water around a face that moves with the solid [1].
  [[nodiscard]] const Buffer<float>& held() const noexcept { return upper_; }
  /// Between full cells, and on the floor beneath one, by how much more of the volume around a
  /// face is open than of its area, of a whole cell [1].
  [[nodiscard]] const Buffer<float>& excess() const noexcept { return excess_; }
  [[nodiscard]] const Buffer<float>& space() const noexcept { return space_; }
  [[nodiscard]] const Buffer<int>& owner() const noexcept { return owner_; }

 private:
  const MacFields& fields_;
  bool any_;
  Buffer<float> volume_;  ///< open part of the volume around faces [1]
  Buffer<float> upper_;   ///< of the upper half of cells along each axis, then held() [1]
  Buffer<float> gap_;  ///< of the lower half of cells along each axis, then open part of faces [1]
  Buffer<float> excess_;
  Buffer<float> depth_;       ///< how deep cells reach into solids [cells]
  Buffer<float> airless_;     ///< 1: a cell held water or no open space in the last step; else 0
  Buffer<float> space_;       ///< of cells [1]
  Buffer<int> owner_;         ///< whose a cell is (room.h)
  Buffer<float> seen_space_;  ///< open part of what a cell's hat sees [1]
  Buffer<float> clear_;       ///< 1: no water touches a body near the cell; 0: some does [1]
  Buffer<float> filled_;
  Kernel cut_cells_;
  Kernel see_space_;
  Kernel fill_beside_solids_;
  Kernel open_areas_;
};

}  // namespace splash::sim
