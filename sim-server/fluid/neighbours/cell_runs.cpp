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
      count_cells_(program, "count_cells", 1),
      sum_blocks_(program, "sum_blocks", 1),
      place_cells_(program, "place_cells", 1),
      sort_points_(program, "sort_points", 1) {}

void CellRuns::sort(cl::CommandQueue& queue, const Buffer<FluidParams>& params, int points,
                    const PointArrays& from, const PointArrays& to, const Buffer<int>& cell_start,
                    const Buffer<int>& source) {
  const auto chunks = static_cast<std::size_t>(chunks_);
  const auto blocks = static_cast<std::size_t>(blocks_);
  const int whole = points == sorted_points_ ? 0 : 1;
  sorted_points_ = points;
  count_cells_.run(queue, chunks,
                   {{"p", params},
                    {"points", points},
                    {"stride", from.stride},
                    {"chunks", chunks_},
                    {"whole", whole},
                    {"position", from.position},
                    {"cells", cells_},
                    {"count", count_},
                    {"extent", extent_}});
  sum_blocks_.run(queue, blocks,
                  {{"p", params},
                   {"chunks", chunks_},
                   {"blocks", blocks_},
                   {"whole", whole},
                   {"extent", extent_},
                   {"count", count_},
                   {"block_sum", block_sum_}});
  place_cells_.run(queue, blocks,
                   {{"p", params},
                    {"chunks", chunks_},
                    {"blocks", blocks_},
                    {"whole", whole},
                    {"extent", extent_},
                    {"block_sum", block_sum_},
                    {"count", count_},
                    {"cell_start", cell_start}});
  sort_points_.run(queue, chunks,
                   {{"p", params},
                    {"points", points},
                    {"stride", from.stride},
                    {"chunks", chunks_},
                    {"whole", whole},
                    {"cells", cells_},
                    {"place", count_},
                    {"position", from.position},
                    {"velocity", from.velocity},
                    {"id", from.id},
                    {"position_out", to.position},
                    {"velocity_out", to.velocity},
                    {"id_out", to.id},
                    {"source", source},
                    {"extent", extent_}});
}

}  // namespace splash::sim
