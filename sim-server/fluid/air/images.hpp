// SPDX-License-Identifier: MIT
// The water's mirror images behind the tank's walls: with them a colour field reads the same beside
// a wall as far from it.
#pragma once

#include <vector>

#include "sim-server/scene/scene.hpp"

namespace splash::sim {

/// `points` [m], followed by the images of those less than `reach` [m] from the floor or a side of
/// the tank; images of images fill the corners. The top is open.
[[nodiscard]] std::vector<Vector3> with_images(std::vector<Vector3> points, const Tank& tank,
                                               double reach);

}  // namespace splash::sim
