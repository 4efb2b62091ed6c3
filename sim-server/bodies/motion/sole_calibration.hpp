// SPDX-License-Identifier: MIT
// Where the sole is on a foot of which only markers are known.
//
// The floor tells. While a foot stands its sole is on the floor, so the heights of the markers
// above the sole follow from the frames in which it stands flat; and in every step the curved heel
// meets the floor while the toes are still up, so the sole is pushed back along the foot until it
// does so in all complete steps. Both are seen under load. Sole and heel pad give way by some
// millimetres then (kSoftness), so the sole that comes down unloaded reaches that much lower.
#pragma once

#include <span>

#include "sim-server/bodies/motion/rigid_fit.hpp"
#include "sim-server/scene/scene.hpp"

namespace splash::sim {

/// By how much a loaded sole and heel pad are thinner than unloaded ones [m].
inline constexpr double kSoftness = 0.003;

/// Lowest point of the sole above the floor z = 0 [m] in one pose of the foot's frame, the box's
/// centre at `centre` in that frame; `rear_only`: only of its half towards -x.
[[nodiscard]] double sole_height(const Shape& shape, const Vector3& centre, const RigidFit& foot,
                                 bool rear_only = false);

/// The centre of the box in the foot's frame. `foot`: its pose in each frame of a recording. The
/// frame's z is up and zero on the floor when the foot stands flat, x points to the toes;
/// `width_centre` is the middle of the foot across [m].
[[nodiscard]] Vector3 calibrate_sole(const Shape& shape, std::span<const RigidFit> foot,
                                     double width_centre);

}  // namespace splash::sim
