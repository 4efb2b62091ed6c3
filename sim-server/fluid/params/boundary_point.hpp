// SPDX-License-Identifier: MIT
// A rigid body as the fluid sees it: points in it, and the faces of its skin.
#pragma once

#include "sim-server/scene/scene.hpp"

namespace splash::sim {

struct BoundaryPoint {
  Vector3 place = {0.0, 0.0, 0.0};  ///< in body axes, from its centre [m]
  int owner = 0;                    ///< index of the body
  double volume = 0.0;              ///< of the water it stands for [m3]
};

/// Part of a body's surface, on which films press (free_bodies/body_film.cl).
struct SkinFace {
  Vector3 place = {0.0, 0.0, 0.0};  ///< in body axes, from its centre [m]
  Vector3 area = {0.0, 0.0, 0.0};   ///< outwards, in body axes [m2]
  int owner = 0;                    ///< index of the body
};

}  // namespace splash::sim
