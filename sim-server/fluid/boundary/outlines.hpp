// SPDX-License-Identifier: MIT
// The bodies' outlines as the device has them (boundary/outline.h).
#pragma once

#include <vector>

#include "sim-server/fluid/params/fluid_params.h"
#include "sim-server/scene/scene.hpp"

namespace splash::sim {

struct Outlines {
  std::vector<BodyShape> shapes;  ///< one for each body
  std::vector<float> meshes;      ///< distances and vertices of those that are meshes [m]
};

/// Throws std::length_error where the meshes have more numbers than an int counts.
[[nodiscard]] Outlines body_outlines(const std::vector<BodySettings>& bodies);

}  // namespace splash::sim
