// SPDX-License-Identifier: MIT
#include "sim-server/fluid/neighbour_grid.hpp"

#include <vector>

namespace splash::sim {
namespace {

/// Where array ends are parked: no kernel reaches them, and their squares are still finite [m].
constexpr float kFarAway = 1.0e6F;

}  // namespace

PointArrays::PointArrays(Device& device, std::size_t points) {
  const std::size_t room = (points + kReadAhead + 15) / 16 * 16;
  stride = static_cast<int>(room);
  position = Buffer<float>(device, std::vector<float>(3 * room + kReadAhead, kFarAway));
  velocity = Buffer<float>(device, 3 * room + kReadAhead);
  id = Buffer<int>(device, room);
}

NeighbourGrid::NeighbourGrid(Device& device, const cl::Program& program, const FluidParams& params,
                             std::size_t max_points, int chunks)
    : chunks_(chunks),
      blocks_(4 * chunks),
      count_cells_(program, "count_cells"),
      sum_blocks_(program, "sum_blocks"),
      place_cells_(program, "place_cells"),
      sort_points_(program, "sort_points") {
  const std::size_t cells = SPLASH_SLICES * static_cast<std::size_t>(params.cells_x) *
                            static_cast<std::size_t>(params.cells_y) *
                            static_cast<std::size_t>(params.cells_z);
  cells_ = Buffer<int>(device, max_points);
  count_ = Buffer<int>(device, cells * static_cast<std::size_t>(chunks));
  block_sum_ = Buffer<int>(device, static_cast<std::size_t>(blocks_));
  cell_start_ = Buffer<int>(device, cells + 1);
  source_ = Buffer<int>(device, max_points);
  extent_ = Buffer<int>(device, static_cast<std::size_t>(chunks) + 2);
}

void NeighbourGrid::sort(cl::CommandQueue& queue, const Buffer<FluidParams>& params, int points,
                         const PointArrays& from, const PointArrays& to) {
  const auto chunks = static_cast<std::size_t>(chunks_);
  const auto blocks = static_cast<std::size_t>(blocks_);
  const int whole = points == sorted_points_ ? 0 : 1;
  sorted_points_ = points;
  count_cells_.run(queue, chunks, params.memory(), points, from.stride, chunks_, whole,
                   from.position.memory(), cells_.memory(), count_.memory(), extent_.memory());
  sum_blocks_.run(queue, blocks, params.memory(), chunks_, blocks_, whole, extent_.memory(),
                  count_.memory(), block_sum_.memory());
  place_cells_.run(queue, blocks, params.memory(), chunks_, blocks_, whole, extent_.memory(),
                   block_sum_.memory(), count_.memory(), cell_start_.memory());
  sort_points_.run(queue, chunks, params.memory(), points, from.stride, chunks_, whole,
                   cells_.memory(), count_.memory(), from.position.memory(), from.velocity.memory(),
                   from.id.memory(), to.position.memory(), to.velocity.memory(), to.id.memory(),
                   source_.memory(), extent_.memory());
}

}  // namespace splash::sim
