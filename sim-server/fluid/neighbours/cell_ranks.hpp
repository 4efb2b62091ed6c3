// SPDX-License-Identifier: MIT
// The sort for GPUs: one work-item for each point, work and memory in proportion to points and
// cells (neighbours/cell_rank.cl).
#pragma once

#include "sim-server/device/kernel.hpp"
#include "sim-server/fluid/neighbours/point_arrays.hpp"
#include "sim-server/fluid/params/fluid_params.h"

namespace splash::sim {

class CellRanks {
 public:
  CellRanks() = default;
  /// `cells`: of the grid.
  CellRanks(Device& device, const cl::Program& program, std::size_t cells, std::size_t max_points);

  /// Like CellRuns::sort.
  void sort(cl::CommandQueue& queue, const Buffer<FluidParams>& params, int points,
            const PointArrays& from, const PointArrays& to, const Buffer<int>& cell_start,
            const Buffer<int>& source);

 private:
  std::size_t block_ = 1;   ///< cells that one work-group starts
  std::size_t blocks_ = 1;  ///< of cells
  Buffer<int> cells_;       ///< of each point
  Buffer<int> count_;       ///< zeros between sorts
  Buffer<int> block_sum_;
  Buffer<int> order_;  ///< points by cells
  Kernel count_points_;
  Kernel sum_cells_;
  Kernel start_cells_;
  Kernel gather_cells_;
  Kernel rank_points_;
};

}  // namespace splash::sim
