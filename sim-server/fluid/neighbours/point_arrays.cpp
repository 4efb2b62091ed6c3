// SPDX-License-Identifier: MIT
#include "sim-server/fluid/neighbours/point_arrays.hpp"

#include <vector>

#include "sim-server/fluid/lanes/far_away.h"

namespace splash::sim {

PointArrays::PointArrays(Device& device, std::size_t points) {
  const std::size_t room = (points + kReadAhead + 15) / 16 * 16;
  stride = static_cast<int>(room);
  position = Buffer<float>(device, std::vector<float>(3 * room + kReadAhead, SPLASH_FAR_AWAY));
  velocity = Buffer<float>(device, 3 * room + kReadAhead);
  id = Buffer<int>(device, room);
}

}  // namespace splash::sim
