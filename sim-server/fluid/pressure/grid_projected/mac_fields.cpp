// SPDX-License-Identifier: MIT
#include "sim-server/fluid/pressure/grid_projected/mac_fields.hpp"

namespace splash::sim {
namespace {

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

}  // namespace splash::sim
