// SPDX-License-Identifier: MIT
#include "sim-server/fluid/neighbours/cell_runs.hpp"

namespace splash::sim {

CellRuns::CellRuns(Device& device, const cl::Program& program, std::size_t cells,
                   std::size_t max_points, int chunks)
    : chunks_(chunks),
      blocks_(4 * chunks),
      cells_(device, max_points),
      count_(device, cells * static_cast<std::size_t>(chunks)),
      block_sum_(device, static_cast<std::size_t>(blocks_)),
      extent_(device, static_cast<std::size_t>(chunks) + 2),
      count_cells_(program, "count_cells"),
      sum_blocks_(program, "sum_blocks"),
      place_cells_(program, "place_cells"),
      sort_points_(program, "sort_points") {}

void CellRuns::sort(cl::CommandQueue& queue, const Buffer<FluidParams>& params, int points,
                    const PointArrays& from, const PointArrays& to, const Buffer<int>& cell_start,
                    const Buffer<int>& source) {
  const auto chunks = static_cast<std::size_t>(chunks_);
  const auto blocks = static_cast<std::size_t>(blocks_);
  const int whole = points == sorted_points_ ? 0 : 1;
  sorted_points_ = points;
  count_cells_.run(queue, chunks, params.memory(), points, from.stride, chunks_, whole,
                   from.position.memory(), cells_.memory(), count_.memory(), extent_.memory());
  sum_blocks_.run(queue, blocks, params.memory(), chunks_, blocks_, whole, extent_.memory(),
                  count_.memory(), block_sum_.memory());
  place_cells_.run(queue, blocks, params.memory(), chunks_, blocks_, whole, extent_.memory(),
                   block_sum_.memory(), count_.memory(), cell_start.memory());
  sort_points_.run(queue, chunks, params.memory(), points, from.stride, chunks_, whole,
                   cells_.memory(), count_.memory(), from.position.memory(), from.velocity.memory(),
                   from.id.memory(), to.position.memory(), to.velocity.memory(), to.id.memory(),
                   source.memory(), extent_.memory());
}

}  // namespace splash::sim
