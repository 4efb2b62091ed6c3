// SPDX-License-Identifier: MIT
// Points on the device: fluid particles, body points and bubbles alike.
#pragma once

#include "sim-server/device/buffer.hpp"

namespace splash::sim {

/// Vectors of neighbours may be read this far past the last point.
inline constexpr std::size_t kReadAhead = 32;

/// Points as structure of arrays: x, y and z parts `stride` elements apart.
struct PointArrays {
  PointArrays() = default;
  /// Room for `points` and the read-ahead, filled with far away points at rest.
  PointArrays(Device& device, std::size_t points);

  int stride = 0;
  Buffer<float> position;  ///< [m]
  Buffer<float> velocity;  ///< [m/s]
  Buffer<int> id;          ///< stays with its point through all sorts
};

}  // namespace splash::sim
