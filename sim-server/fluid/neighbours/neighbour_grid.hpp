// SPDX-License-Identifier: MIT
// Points sorted by the grid cell they are in: fluid particles, body points and bubbles alike.
#pragma once

#include <variant>

#include "sim-server/fluid/neighbours/cell_ranks.hpp"
#include "sim-server/fluid/neighbours/cell_runs.hpp"

namespace splash::sim {

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
