// SPDX-License-Identifier: MIT
// What is said of a body that poses put where no water can be meant: the sender's unit, axes or
// origin are likely to be others than the scene's.
#pragma once

#include <optional>
#include <string>

#include "sim-server/scene/scene.hpp"

namespace splash::sim {

/// "39.4 m outside of the tank" or "0.85 m below the tank's floor"; empty: the place [m] is none to
/// wonder at.
[[nodiscard]] std::optional<std::string> far_off(const Tank& tank, const Vector3& place);

/// "0.30 1.20 -0.85 m".
[[nodiscard]] std::string in_metres(const Vector3& place);

}  // namespace splash::sim
