// SPDX-License-Identifier: MIT
// The motion that a scene's body asks for.
#pragma once

#include <filesystem>
#include <memory>

#include "sim-server/bodies/motion/motion.hpp"
#include "sim-server/scene/scene.hpp"

namespace splash::sim {

/// `tracker_override`: a TRC file that bodies of kind trc use instead of the scene's, or empty.
/// A body of kind osc gets a LiveMotion, of kind touch or pressure a FloorMotion, of kind free a
/// FreeMotion. Throws
/// program::ConfigError when a file cannot be read or does not fit the body.
[[nodiscard]] std::unique_ptr<Motion> make_motion(const BodySettings& body,
                                                  const std::filesystem::path& tracker_override);

}  // namespace splash::sim
