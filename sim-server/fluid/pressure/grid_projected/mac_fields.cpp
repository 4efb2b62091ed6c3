// SPDX-License-Identifier: MIT
#include "sim-server/fluid/pressure/grid_projected/mac_fields.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

#include "sim-server/fluid/fluid.hpp"

namespace splash::sim {
namespace {

/// Between levels, so that a vector that begins in one and reads past its end finds nothing of the
/// next.
constexpr int kGap = 32;
/// A layer of cells is whole vectors: none reaches from one into the next.
constexpr int kWhole = 16;
/// The coarsest level has no more cells along any axis.
constexpr int kCoarsest = 2;

struct Box {
  std::array<double, 3> lower;
  std::array<double, 3> upper;
};

/// Between the walls that stand along an axis; upwards, and where there is none, that of the
/// neighbour grid without its margins.
Box room_of(const FluidParams& p) {
  const auto support = static_cast<double>(p.support);
  const std::array<float, 3> origin = {p.origin_x, p.origin_y, p.origin_z};
  const std::array<int, 3> cells = {p.cells_x, p.cells_y, p.cells_z};
  Box box = {};
  for (std::size_t axis = 0; axis < 3; ++axis) {
    box.lower[axis] = static_cast<double>(origin[axis]) + support;
    box.upper[axis] = static_cast<double>(origin[axis]) + (cells[axis] - 1) * support;
  }
  for (int k = 0; k < p.wall_count; ++k) {
    const WallPlane& wall = p.walls[k];
    const std::array<float, 3> normal = {wall.nx, wall.ny, wall.nz};
    const auto offset = static_cast<double>(wall.offset);
    for (std::size_t axis = 0; axis < 3; ++axis) {
      if (normal[axis] == 1.0F) box.lower[axis] = std::max(box.lower[axis], offset);
      if (normal[axis] == -1.0F) box.upper[axis] = std::min(box.upper[axis], -offset);
    }
  }
  return box;
}

MacLevel level_of(int nx, int ny, int nz, int first) {
  const int layer = ((nx + 2) * (ny + 2) + kWhole - 1) / kWhole * kWhole;
  MacLevel level = {nx, ny, nz, nx + 2, layer, 0, first};
  level.cells = level.layer * (nz + 2);
  return level;
}

int half(int cells) {
  return (cells + 1) / 2;
}

std::size_t cells_in(const MacGrid& grid) {
  const MacLevel& level = grid.level[0];
  return static_cast<std::size_t>(level.nx + 1) * static_cast<std::size_t>(level.ny + 1) *
         static_cast<std::size_t>(level.nz + 1);
}

/// Vectors of cells from the lowest layer to the one above the last (mac_cell.h).
std::size_t vectors_in(const MacGrid& grid, const Device& device) {
  const MacLevel& level = grid.level[0];
  return static_cast<std::size_t>(level.layer / device.lanes()) *
         static_cast<std::size_t>(level.nz + 1);
}

}  // namespace

MacGrid lay_mac_grid(const FluidParams& params) {
  const Box box = room_of(params);
  const double wanted = kMacCell * static_cast<double>(params.spacing);
  std::array<int, 3> cells = {};
  std::array<double, 3> edge = {};
  for (std::size_t axis = 0; axis < 3; ++axis) {
    const double length = box.upper[axis] - box.lower[axis];
    cells[axis] = std::max(1, static_cast<int>(std::lround(length / wanted)));
    edge[axis] = length / cells[axis];
  }
  // Nothing is above: there the cells need not fit.
  edge[2] = wanted;
  cells[2] = std::max(1, static_cast<int>(std::ceil((box.upper[2] - box.lower[2]) / wanted)));
  MacGrid grid = {};
  grid.x = static_cast<float>(box.lower[0]);
  grid.y = static_cast<float>(box.lower[1]);
  grid.z = static_cast<float>(box.lower[2]);
  grid.hx = static_cast<float>(edge[0]);
  grid.hy = static_cast<float>(edge[1]);
  grid.hz = static_cast<float>(edge[2]);
  grid.ix = static_cast<float>(1.0 / edge[0]);
  grid.iy = static_cast<float>(1.0 / edge[1]);
  grid.iz = static_cast<float>(1.0 / edge[2]);
  grid.share =
      static_cast<float>(static_cast<double>(params.mass) /
                         static_cast<double>(params.rest_density) / (edge[0] * edge[1] * edge[2]));
  int first = 0;
  MacLevel level = level_of(cells[0], cells[1], cells[2], first);
  while (true) {
    grid.level[grid.levels++] = level;
    first += level.cells + kGap;
    const bool small = std::max({level.nx, level.ny, level.nz}) <= kCoarsest;
    if (small || grid.levels == SPLASH_MAC_LEVELS) break;
    level = level_of(half(level.nx), half(level.ny), half(level.nz), first);
  }
  return grid;
}

std::size_t mac_room(const MacGrid& grid) {
  const MacLevel& last = grid.level[grid.levels - 1];
  return static_cast<std::size_t>(last.first) + static_cast<std::size_t>(last.cells) + kGap;
}

MacFields::MacFields(Device& device, const FluidParams& params)
    : grid(lay_mac_grid(params)),
      cells(cells_in(grid)),
      vectors(vectors_in(grid, device)),
      room(mac_room(grid)),
      team(device.profile().team > 1 ? device.profile().judges : 1),
      on_device(device, std::span<const MacGrid>(&grid, 1)),
      mean(device, 3 * room),
      carries(device, 3 * room),
      weight(device, 3 * room),
      fill(device, room),
      change(device, 3 * room),
      gain(device, 3 * room),
      pressure(device, room),
      wet(device, room),
      air(device, room),
      carried(device, 3 * static_cast<std::size_t>(params.capacity)) {}

std::array<KernelArg, 2> MacFields::args(const Fluid& fluid) const {
  return {{{"p", fluid.params_buffer()}, {"g", on_device}}};
}

}  // namespace splash::sim
