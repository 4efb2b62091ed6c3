// SPDX-License-Identifier: MIT
// Vectors out of the arrays of a device, in which they lie component after component.
#pragma once

#include <cstddef>
#include <vector>

#include "sim-server/scene/scene.hpp"

namespace splash::tests {

/// The first so many.
inline std::vector<sim::Vector3> vectors_of(const std::vector<float>& parts, std::size_t count) {
  std::vector<sim::Vector3> all(count);
  const std::size_t stride = parts.size() / 3;
  for (std::size_t i = 0; i < count; ++i) {
    for (std::size_t axis = 0; axis < 3; ++axis) {
      all[i][axis] = static_cast<double>(parts[axis * stride + i]);
    }
  }
  return all;
}

}  // namespace splash::tests
