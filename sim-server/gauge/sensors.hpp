// SPDX-License-Identifier: MIT
// What gauges read of the water: how high it stands, how far it has come, its pressure, and the air
// below its level.
//
// How high the water stands over a place: where the colour field on a vertical line falls to a
// half.
//   colour(z) = sum_j V W(|x_j - (x, y, z)|),  V = m / rho0, walls mirrored
// Half is the value on a flat surface, and more than a lone particle has (0.23): drops do not
// count.
#pragma once

#include <functional>
#include <span>

#include "sim-server/gauge/water_state.hpp"

namespace splash::sim {

struct Height {
  double top = 0.0;     ///< of the highest water above the floor; 0: dry [m]
  double wetted = 0.0;  ///< length of the line that is in water, as a wire gauge reads it [m]
};

/// Points less than `reach` from the vertical line [m].
[[nodiscard]] std::vector<Vector3> near_line(std::span<const Vector3> points, double x, double y,
                                             double reach);

/// `points`: the water with its images; `x`, `y`: the line; `floor`: where it begins [m].
[[nodiscard]] Height water_height(std::span<const Vector3> points, const WaterState& water,
                                  double x, double y, double floor);

// How far the water has come along an axis: the farthest slab, one spacing thick across the whole
// tank, that holds half the particles of one row of water from side to side; half a spacing beyond
// its outermost particle. Drops that fly ahead do not count.

/// `axis`: 0 or 1; `sign`: +1 or -1, the way the front runs; `width`: of the tank across [m].
/// Coordinate along the axis [m]; not a number while no slab is filled.
[[nodiscard]] double front_position(const WaterState& water, std::size_t axis, double sign,
                                    double width);

// Pressure at a point: the mean of what the particles around it say, each carried there as in water
// at rest, so that a sensor in a wall, which has water on one side only, reads no deeper or
// shallower than it lies.
//   p(x) = sum_j (p_j + rho0 g.(x - x_j)) W_j / sum_j W_j, not below 0; 0 where V sum_j W_j < 0.1

/// `water` has pressures; `place` [m]. In Pa above that of the air.
[[nodiscard]] double pressure_at(const WaterState& water, const Vector3& place);

// How the water flows at a point: the mean of the particles around it.
//   v(x) = sum_j v_j W_j / sum_j W_j; 0 where V sum_j W_j < 0.1, the colour

struct FlowAt {
  Vector3 velocity = {0.0, 0.0, 0.0};  ///< [m/s]
  double colour = 0.0;                 ///< 1 within water, 1/2 on its surface or a wall, 0: dry [1]
};

[[nodiscard]] FlowAt flow_at(const WaterState& water, const Vector3& place);

// Air below the water's level: a hollow that is open to the air above, and pockets that the water
// has closed around (fluid/air/air_cells.hpp).

struct Cavity {
  double open = 0.0;      ///< [m3]
  double enclosed = 0.0;  ///< all pockets [m3]
  double pocket = 0.0;    ///< the largest of them [m3]
};

/// `points`: the water with its images; `lower`, `upper`: the region, whose top is the level [m];
/// `solid`: whether a body is at a place.
[[nodiscard]] Cavity find_cavity(std::span<const Vector3> points, const WaterState& water,
                                 const Vector3& lower, const Vector3& upper,
                                 const std::function<bool(const Vector3&)>& solid);

}  // namespace splash::sim
