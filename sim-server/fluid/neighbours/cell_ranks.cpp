// SPDX-License-Identifier: MIT
#include "sim-server/fluid/neighbours/cell_ranks.hpp"

#include <algorithm>

namespace splash::sim {
namespace {

/// Cells that one work-group starts: at least so many, and so many that the sums of so many blocks
/// are all that each has to add up.
constexpr std::size_t kLeastBlock = 1024;
constexpr std::size_t kMostBlocks = 1024;

}  // namespace

CellRanks::CellRanks(Device& device, const cl::Program& program, std::size_t cells,
                     std::size_t max_points)
    : block_(std::max(kLeastBlock, (cells + kMostBlocks - 1) / kMostBlocks)),
      blocks_((cells + block_ - 1) / block_),
      cells_(device, max_points),
      count_(device, cells),
      block_sum_(device, blocks_),
      order_(device, max_points),
      count_points_(program, "count_points"),
      sum_cells_(program, "sum_cells", device.profile().team),
      start_cells_(program, "start_cells", device.profile().team),
      gather_cells_(program, "gather_cells"),
      rank_points_(program, "rank_points") {}

void CellRanks::sort(cl::CommandQueue& queue, const Buffer<FluidParams>& params, int points,
                     const PointArrays& from, const PointArrays& to, const Buffer<int>& cell_start,
                     const Buffer<int>& source) {
  const auto items = static_cast<std::size_t>(points);
  const auto block = static_cast<int>(block_);
  const Buffer<int>& arrival = source;  // nobody asks for the source until the end
  count_points_.run(queue, items,
                    {{"p", params},
                     {"points", points},
                     {"stride", from.stride},
                     {"position", from.position},
                     {"cells", cells_},
                     {"count", count_},
                     {"arrival", arrival}});
  sum_cells_.run_teams(
      queue, blocks_,
      {{"p", params}, {"block", block}, {"count", count_}, {"block_sum", block_sum_}});
  start_cells_.run_teams(queue, blocks_,
                         {{"p", params},
                          {"block", block},
                          {"points", points},
                          {"block_sum", block_sum_},
                          {"count", count_},
                          {"cell_start", cell_start}});
  gather_cells_.run(queue, items,
                    {{"points", points},
                     {"cells", cells_},
                     {"cell_start", cell_start},
                     {"arrival", arrival},
                     {"order", order_}});
  rank_points_.run(queue, items,
                   {{"points", points},
                    {"stride", from.stride},
                    {"cells", cells_},
                    {"cell_start", cell_start},
                    {"order", order_},
                    {"position", from.position},
                    {"velocity", from.velocity},
                    {"id", from.id},
                    {"position_out", to.position},
                    {"velocity_out", to.velocity},
                    {"id_out", to.id},
                    {"source", source}});
}

}  // namespace splash::sim
