// SPDX-License-Identifier: MIT
// Pressure on a wall or a body as a sensor feels it: the force of the water on its face by the
// face's area. Where water is at rest, all forces on a floor are the water's weight, whatever
// pressures the particles beside it have to take to carry it.
//   p = sum f.n w(q) / cover
// f: what one particle does to the wall, or to one point of the body; n into the solid; q: its foot
// on the wall, or where the line from particle to point passes the plane of the face (Irving &
// Kirkwood 1950); w: face_weight. What an edge takes from the face is filled up as in water at
// rest.
#pragma once

#include <span>

#include "sim-server/bodies/body_points.hpp"
#include "sim-server/gauge/face.hpp"
#include "sim-server/gauge/water_state.hpp"

namespace splash::sim {

/// In Pa above that of the air, not below 0. `water` has pressures and wall pushes; `points`: of
/// all bodies; `states`: of all bodies.
[[nodiscard]] double thrust_on(const Face& face, const WaterState& water,
                               std::span<const BodyPoint> points,
                               std::span<const BodyState> states);

}  // namespace splash::sim
