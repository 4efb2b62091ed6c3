// SPDX-License-Identifier: MIT
// The sort for CPUs: a few runs of points side by side, each with its own count of every cell
// (neighbours/cell_count.cl, neighbours/cell_sort.cl).
#pragma once

#include "sim-server/device/kernel.hpp"
#include "sim-server/fluid/neighbours/point_arrays.hpp"
#include "sim-server/fluid/params/fluid_params.h"

namespace splash::sim {

class CellRuns {
 public:
  CellRuns() = default;
  /// `cells`: of the grid; `chunks`: runs of points, at least one.
  CellRuns(Device& device, const cl::Program& program, std::size_t cells, std::size_t max_points,
           int chunks);

  /// Sorts `points` of `from` into `to`. `cell_start`: first point of each cell, one entry more
  /// than cells; `source`: where each sorted point was before.
  void sort(cl::CommandQueue& queue, const Buffer<FluidParams>& params, int points,
            const PointArrays& from, const PointArrays& to, const Buffer<int>& cell_start,
            const Buffer<int>& source);

 private:
  int chunks_ = 1;
  int blocks_ = 1;
  Buffer<int> cells_;  ///< of each point
  Buffer<int> count_;
  Buffer<int> block_sum_;
  Buffer<int> extent_;      ///< cells in use (neighbours/cell_count.cl)
  int sorted_points_ = -1;  ///< of the last sort
  Kernel count_cells_;
  Kernel sum_blocks_;
  Kernel place_cells_;
  Kernel sort_points_;
};

}  // namespace splash::sim
