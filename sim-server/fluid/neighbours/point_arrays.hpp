// SPDX-License-Identifier: MIT
// Points on the device: fluid particles, body points and bubbles alike.
#pragma once

#include <vector>

#include "sim-server/device/buffer.hpp"
#include "sim-server/fluid/lanes/far_away.h"

namespace splash::sim {

/// Vectors of neighbours may be read this far past the last point.
inline constexpr std::size_t kReadAhead = 32;

/// Points as structure of arrays: x, y and z parts `stride` elements apart.
struct PointArrays {
  PointArrays() = default;
  /// Room for `points` and the read-ahead, filled with far away points at rest.
  PointArrays(Device& device, std::size_t points)
      : stride(static_cast<int>((points + kReadAhead + 15) / 16 * 16)),
        position(device, std::vector<float>(3 * room() + kReadAhead, SPLASH_FAR_AWAY)),
        velocity(device, 3 * room() + kReadAhead),
        id(device, room()) {}

  int stride = 0;
  Buffer<float> position;  ///< [m]
  Buffer<float> velocity;  ///< [m/s]
  Buffer<int> id;          ///< stays with its point through all sorts

 private:
  [[nodiscard]] std::size_t room() const noexcept { return static_cast<std::size_t>(stride); }
};

}  // namespace splash::sim
