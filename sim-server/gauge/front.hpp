// SPDX-License-Identifier: MIT
// How far the water has come along an axis: the farthest slab, one spacing thick across the whole
// tank, that holds half the particles of one row of water from side to side; half a spacing beyond
// its outermost particle. Drops that fly ahead do not count.
#pragma once

#include "sim-server/gauge/water_state.hpp"

namespace splash::sim {

/// `axis`: 0 or 1; `sign`: +1 or -1, the way the front runs; `width`: of the tank across [m].
/// Coordinate along the axis [m]; not a number while no slab is filled.
[[nodiscard]] double front_position(const WaterState& water, std::size_t axis, double sign,
                                    double width);

}  // namespace splash::sim
