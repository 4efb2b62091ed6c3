// SPDX-License-Identifier: MIT
// The image of the water behind a body's face (boundary/body_image.h) in double precision;
// gradients by differences.
#pragma once

#include "tests/sim-server/fluid/reference.hpp"

namespace splash::sim {

/// R, its gradient, and which body is the nearest.
struct ReferenceImage {
  double factor = 1.0;                 ///< [1]
  Vector3 gradient = {0.0, 0.0, 0.0};  ///< [1/m]
  std::size_t owner = 0;
};

/// Without bodies: 1 everywhere.
[[nodiscard]] ReferenceImage reference_image(const FluidState& state, const Vector3& place);

}  // namespace splash::sim
