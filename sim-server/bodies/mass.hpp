// SPDX-License-Identifier: MIT
// Mass and moments of inertia of free bodies.
#pragma once

#include <vector>

#include "sim-server/fluid/fluid_params.h"
#include "sim-server/scene/scene.hpp"

namespace splash::sim {

/// Of a free body [kg].
[[nodiscard]] double mass_of(const BodySettings& body);

/// Moments of inertia of a homogeneous body of `mass` [kg] about its own axes through its centre
/// [kg m2]: box m (b^2 + c^2) / 12, sphere m d^2 / 10, cylinder m d^2 / 8 along and
/// m (3/4 d^2 + l^2) / 12 across its axis. A box's curved sole is not looked at.
[[nodiscard]] Vector3 inertia_of(const Shape& shape, double mass);

/// The free ones of a scene's bodies, for the device.
[[nodiscard]] std::vector<FreeBody> free_bodies(const std::vector<BodySettings>& bodies);

}  // namespace splash::sim
