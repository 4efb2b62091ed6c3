// SPDX-License-Identifier: MIT
// Whether a body whose way is known beforehand goes through the floor or a wall of its tank: its
// box does not fit what was recorded, or its path is too low. The water there is squeezed out and
// thrown about.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "sim-server/scene/scene.hpp"

namespace splash::sim {

/// Where on its way a body is deepest in what is solid, while its centre is between the walls.
struct Digging {
  double depth = 0.0;    ///< below the floor or beyond a wall; 0: nowhere [m]
  double seconds = 0.0;  ///< simulated time [s]
  std::string solid;     ///< "below the floor" or "through the wall at x = 1 m"
  Vector3 point = {};    ///< that is deepest, in the body's axes [m]
};

/// Of the scene's body of this index; nothing of one that water or an OSC tracker moves. The floor
/// of a sole is the recording's, z = 0. `tracker` as for make_motion, which may throw.
[[nodiscard]] Digging deepest_digging(const Scene& scene, std::size_t body,
                                      const std::filesystem::path& tracker);

/// A line for each body that digs deeper than a particle's spacing, and squeezes water out there:
/// by how much, when, and for a sole the length of the box that would fit. Soles give way by some
/// millimetres, and edges of a box dig when a foot rolls: less is not told.
[[nodiscard]] std::vector<std::string> digging_notices(const Scene& scene,
                                                       const std::filesystem::path& tracker);

}  // namespace splash::sim
