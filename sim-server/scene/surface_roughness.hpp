// SPDX-License-Identifier: MIT
// How rough the surface is of water that is made of particles.
#pragma once

namespace splash::sim {

/// The surface of the particles is this rough: nearer, body and water touch [spacings].
inline constexpr double kSurfaceRoughness = 0.1;

}  // namespace splash::sim
