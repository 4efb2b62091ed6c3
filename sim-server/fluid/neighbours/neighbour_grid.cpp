// SPDX-License-Identifier: MIT
#include "sim-server/fluid/neighbours/neighbour_grid.hpp"

#include <algorithm>

namespace splash::sim {
namespace {

/// Cells that one work-group starts: at least so many, and so many that the sums of so many blocks
/// are all that each has to add up.
constexpr std::size_t kLeastBlock = 1024;
constexpr std::size_t kMostBlocks = 1024;

std::size_t cells_of(const FluidParams& params) {
  return SPLASH_SLICES * static_cast<std::size_t>(params.cells_x) *
         static_cast<std::size_t>(params.cells_y) * static_cast<std::size_t>(params.cells_z);
}

}  // namespace

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
      sort_points_(program, "sort_points", 1),
      sort_few_(program, "sort_few", 1) {}

void CellRuns::sort(cl::CommandQueue& queue, const Buffer<FluidParams>& params, int points,
                    const PointArrays& from, const PointArrays& to, const Buffer<int>& cell_start,
                    const Buffer<int>& source) {
  const auto chunks = static_cast<std::size_t>(chunks_);
  const auto blocks = static_cast<std::size_t>(blocks_);
  const int whole = points == sorted_points_ ? 0 : 1;
  sorted_points_ = points;
  if (chunks_ == 1) {
    sort_few_.run(queue, 1,
                  {{"p", params},
                   {"points", points},
                   {"stride", from.stride},
                   {"whole", whole},
                   {"position", from.position},
                   {"velocity", from.velocity},
                   {"id", from.id},
                   {"cells", cells_},
                   {"count", count_},
                   {"block_sum", block_sum_},
                   {"extent", extent_},
                   {"cell_start", cell_start},
                   {"position_out", to.position},
                   {"velocity_out", to.velocity},
                   {"id_out", to.id},
                   {"source", source}});
    return;
  }
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
  const Buffer<int>& arrival = source;  // its memory is free until the last kernel writes `source`
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
