// SPDX-License-Identifier: MIT
#include "sim-server/fluid/neighbours/neighbour_grid.hpp"

namespace splash::sim {
namespace {

std::size_t cells_of(const FluidParams& params) {
  return SPLASH_SLICES * static_cast<std::size_t>(params.cells_x) *
         static_cast<std::size_t>(params.cells_y) * static_cast<std::size_t>(params.cells_z);
}

}  // namespace

NeighbourGrid::NeighbourGrid(Device& device, const cl::Program& program, const FluidParams& params,
                             std::size_t max_points, int chunks)
    : cell_start_(device, cells_of(params) + 1), source_(device, max_points) {
  if (chunks == 0) {
    cells_ = CellRanks(device, program, cells_of(params), max_points);
  } else {
    cells_ = CellRuns(device, program, cells_of(params), max_points, chunks);
  }
}

void NeighbourGrid::sort(cl::CommandQueue& queue, const Buffer<FluidParams>& params, int points,
                         const PointArrays& from, const PointArrays& to) {
  std::visit(
      [&](auto& cells) { cells.sort(queue, params, points, from, to, cell_start_, source_); },
      cells_);
}

}  // namespace splash::sim
