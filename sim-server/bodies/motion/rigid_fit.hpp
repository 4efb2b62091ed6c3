// SPDX-License-Identifier: MIT
// The rigid motion that best takes one set of points to another, in the sense of least squares.
#pragma once

#include <span>

#include "sim-server/scene/scene.hpp"

namespace splash::sim {

struct RigidFit {
  Quaternion rotation = {0.0, 0.0, 0.0, 1.0};  ///< measured = rotation * reference + translation
  Vector3 translation = {};                    ///< [m]
};

/// By unit quaternions (Horn 1987, J. Opt. Soc. Am. A 4, 629), so that it is never a reflection.
/// Throws std::invalid_argument: fewer than three points, sets of unlike size, or points (almost)
/// on one line, which leave a turn about it open.
[[nodiscard]] RigidFit fit_rigid(std::span<const Vector3> reference,
                                 std::span<const Vector3> measured);
/// Whether the points are enough for a fit: three or more, not on a line.
[[nodiscard]] bool spans_plane(std::span<const Vector3> points);

}  // namespace splash::sim
