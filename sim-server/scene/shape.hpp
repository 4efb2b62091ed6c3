// SPDX-License-Identifier: MIT
// The geometry of bodies: distances from them, and the curved sole of a foot.
#pragma once

#include "sim-server/scene/scene.hpp"

namespace splash::sim {

/// Height of a box's underside above its flat middle at `x` of the body's frame [m]: nothing over
/// the flat share of its length, then a parabola that reaches the rocker at either end.
[[nodiscard]] double rocker_rise(const Shape& shape, double x);

/// Distance from a body's surface [m], negative inside. `point` in the body's frame. A rocker
/// counts as if it were filled.
[[nodiscard]] double distance_to(const Shape& shape, const Vector3& point);

}  // namespace splash::sim
