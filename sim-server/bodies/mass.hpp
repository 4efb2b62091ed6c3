// SPDX-License-Identifier: MIT
// The free bodies of a scene: their mass, how hard they are to turn, and in how long a step they
// may lie on each other.
#pragma once

#include <set>
#include <vector>

#include "sim-server/fluid/params/fluid_params.h"
#include "sim-server/scene/scene.hpp"

namespace splash::sim {

// The free bodies of a scene: their mass and how hard they are to turn.

/// Of a free body [kg].
[[nodiscard]] double mass_of(const BodySettings& body);

/// The free ones of a scene's bodies, for the device; also those on springs.
[[nodiscard]] std::vector<FreeBody> free_bodies(const std::vector<BodySettings>& bodies);
/// Those that go where poses are, then those that poses can take from a motion of their own: their
/// push is felt, their mass is not known and left out. As many as may be free at most, but all of
/// the indices `measured`, which come first.
[[nodiscard]] std::vector<FreeBody> felt_bodies(const std::vector<BodySettings>& bodies,
                                                const std::set<std::size_t>& measured = {});

// How long a step may be in which bodies lie on each other.

/// The longest step in which no body falls farther into the one beneath it than by half the
/// rounding r of its edges, sqrt(r / (2 g)) [s]. A corner that is deeper than r is nearer to the
/// side of what it lies on than to its top, and is put out sideways (free_bodies/outline_gap.h):
/// with twice the fall a stack of ten stood for most of a second, then its plates went into each
/// other. A ball has no corners, and no sides: what it lies on, or what lies on it, sets no limit.
/// Infinite where nothing free with edges can lie on anything with edges, and without `gravity`
/// [m/s2].
[[nodiscard]] double longest_contact_step(const std::vector<BodySettings>& bodies, double gravity);

}  // namespace splash::sim
