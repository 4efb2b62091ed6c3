// SPDX-License-Identifier: MIT
#include "sim-server/fluid/neighbours/point_arrays.hpp"

#include <vector>

namespace splash::sim {
namespace {

/// Where array ends are parked: no kernel reaches them, and their squares are still finite [m].
constexpr float kFarAway = 1.0e6F;

}  // namespace

PointArrays::PointArrays(Device& device, std::size_t points) {
  const std::size_t room = (points + kReadAhead + 15) / 16 * 16;
  stride = static_cast<int>(room);
  position = Buffer<float>(device, std::vector<float>(3 * room + kReadAhead, kFarAway));
  velocity = Buffer<float>(device, 3 * room + kReadAhead);
  id = Buffer<int>(device, room);
}

}  // namespace splash::sim
