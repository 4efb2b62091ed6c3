// SPDX-License-Identifier: MIT
// From markers on a body to the poses of the body.
#pragma once

#include <string>
#include <vector>

#include "sim-server/bodies/motion/marker_file.hpp"
#include "sim-server/scene/scene.hpp"

namespace splash::sim {

/// The body's pose in each frame that shows enough of its markers. `markers` names them; the
/// first two give the body's x axis (heel and toe tip of a foot).
///
/// The markers' places on the body are those of the stillest frame, the one nearest to a uniform
/// level motion (a foot that stands on a treadmill moves). There the body's z is up. The body's
/// centre is the markers' middle or, for a `sole`, as calibrated from the floor: see
/// sole_calibration.
///
/// Throws std::invalid_argument: an unknown marker, no frame with all of them, all on one line.
[[nodiscard]] std::vector<Keyframe> marker_poses(const MarkerRecording& recording,
                                                 const std::vector<std::string>& names,
                                                 const Shape& shape, bool sole);

}  // namespace splash::sim
