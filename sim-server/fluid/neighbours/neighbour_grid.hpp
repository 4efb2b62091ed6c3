// SPDX-License-Identifier: MIT
// Points sorted by the grid cell they are in: fluid particles, body points and bubbles alike.
#pragma once

#include <variant>

#include "sim-server/device/kernel.hpp"
#include "sim-server/fluid/neighbours/point_arrays.hpp"
#include "sim-server/fluid/params/fluid_params.h"

namespace splash::sim {

/// The sort for CPUs: a few runs of points side by side, each with its own count of every cell
/// (neighbours/cell_count.cl).
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
  Kernel sort_few_;  ///< one chunk in one launch
};

/// The sort for GPUs: one work-item for each point, work and memory in proportion to points and
/// cells (neighbours/cell_rank.cl).
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

class NeighbourGrid {
 public:
  NeighbourGrid() = default;
  /// `chunks`: runs of points that are sorted side by side; 0: each by its rank.
  NeighbourGrid(Device& device, const cl::Program& program, const FluidParams& params,
                std::size_t max_points, int chunks);

  /// Sorts the first `points` of `from` into `to`; stable, the same on every run.
  void sort(cl::CommandQueue& queue, const Buffer<FluidParams>& params, int points,
            const PointArrays& from, const PointArrays& to);

  /// Where each sorted point was before the sort.
  [[nodiscard]] const Buffer<int>& source() const noexcept { return source_; }
  /// First point of each cell; one more entry than cells.
  [[nodiscard]] const Buffer<int>& cell_start() const noexcept { return cell_start_; }

 private:
  Buffer<int> cell_start_;
  Buffer<int> source_;
  std::variant<CellRuns, CellRanks> cells_;
};

}  // namespace splash::sim
