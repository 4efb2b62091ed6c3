// SPDX-License-Identifier: MIT
// How the grid that carries the weight is laid into a tank.
#pragma once

#include <cstddef>

#include "sim-server/fluid/params/fluid_params.h"
#include "sim-server/fluid/pressure/grid_projected/mac_grid.h"

namespace splash::sim {

/// Edge of a cell, as nearly as whole numbers of them fill the tank [spacings].
inline constexpr double kMacCell = 2.0;

/// Between the walls, and upwards as far as the neighbour grid. Each level of the multigrid has
/// half the cells of the one before along each axis, down to one or two.
[[nodiscard]] MacGrid lay_mac_grid(const FluidParams& params);

/// Room for an array over all levels, and for vectors that are read past its end.
[[nodiscard]] std::size_t mac_room(const MacGrid& grid);

}  // namespace splash::sim
