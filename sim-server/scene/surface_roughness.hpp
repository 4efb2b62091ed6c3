// SPDX-License-Identifier: MIT
// How exactly water made of particles has a surface.
#pragma once

namespace splash::sim {

/// The surface of the particles is this rough: nearer, body and water touch [spacings].
inline constexpr double kSurfaceRoughness = 0.1;

}  // namespace splash::sim
