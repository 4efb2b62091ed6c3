// SPDX-License-Identifier: MIT
// What a floor says of a body that stands on it.
#pragma once

#include <cstddef>
#include <functional>
#include <optional>

#include "sim-server/scene/scene.hpp"

namespace splash::sim {

struct FloorTouch {
  std::size_t body = 0;                     ///< index among the scene's
  bool down = false;                        ///< false: it has left the floor
  Vector3 place = {};                       ///< where it stands, while it does [m]
  std::optional<Quaternion> rotation = {};  ///< body to world, where that is known
};
using GiveTouch = std::function<void(const FloorTouch& touch)>;

}  // namespace splash::sim
