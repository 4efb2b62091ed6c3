// SPDX-License-Identifier: MIT
// How long a step may be in which bodies lie on each other.
#pragma once

#include <vector>

#include "sim-server/scene/scene.hpp"

namespace splash::sim {

/// The longest step in which no body falls farther into the one beneath it than by half the
/// rounding r of its edges, sqrt(r / (2 g)) [s]. A corner that is deeper than r is nearer to the
/// side of what it lies on than to its top, and is put out sideways (free_bodies/outline_gap.h):
/// with twice the fall a stack of ten stood for most of a second, then its plates went into each
/// other. Infinite where nothing free can lie on anything, and without `gravity` [m/s2].
[[nodiscard]] double longest_contact_step(const std::vector<BodySettings>& bodies, double gravity);

}  // namespace splash::sim
