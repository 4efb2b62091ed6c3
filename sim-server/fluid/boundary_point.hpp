// SPDX-License-Identifier: MIT
// A point of a rigid body as the fluid sees it.
#pragma once

#include "sim-server/scene/scene.hpp"

namespace splash::sim {

struct BoundaryPoint {
  Vector3 place = {0.0, 0.0, 0.0};  ///< in body axes, from its centre [m]
  int owner = 0;                    ///< index of the body
  double volume = 0.0;              ///< of the water it stands for [m3]
};

}  // namespace splash::sim
