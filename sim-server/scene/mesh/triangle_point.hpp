// SPDX-License-Identifier: MIT
// The point of a triangle that is nearest to a place, and on which part of it that is (Ericson
// 2005, Real-Time Collision Detection, 5.1.5).
#pragma once

#include <array>

#include "sim-server/scene/scene.hpp"

namespace splash::sim {

/// Corner k, the side from corner k to the next, or what lies between them.
enum class TrianglePart { corner_0, corner_1, corner_2, side_0, side_1, side_2, inside };

struct TrianglePoint {
  Vector3 place = {0.0, 0.0, 0.0};  ///< [m]
  TrianglePart part = TrianglePart::inside;
};

/// `corner`: of a triangle that has an area [m].
[[nodiscard]] TrianglePoint nearest_on(const std::array<Vector3, 3>& corner, const Vector3& place);

}  // namespace splash::sim
