// SPDX-License-Identifier: MIT
// What a scene is before its time begins: bodies where their motions start, water around them, the
// flow it starts with.
#pragma once

#include <filesystem>
#include <vector>

#include "sim-server/bodies/body_steps.hpp"
#include "sim-server/bodies/motion/live_motion.hpp"
#include "sim-server/fluid/fluid.hpp"
#include "sim-server/scene/scene.hpp"
#include "sim-server/scene/support_state.hpp"

namespace splash::sim {

/// The scene's bodies. `tracker`: a marker file that replaces the scene's, or empty. `live` gets
/// one entry a body: what an OSC tracker moves it by, or null. Throws program::ConfigError for
/// motions that cannot be read.
[[nodiscard]] Bodies make_bodies(const Scene& scene, const std::filesystem::path& tracker,
                                 std::vector<PosedMotion*>& live);

/// Where the bodies are when time begins, one entry each.
[[nodiscard]] std::vector<Keyframe> poses_at_start(const Bodies& bodies);

/// The scene's water under its own weight, with no particle in a body. `support_states` gets one
/// entry a particle, by its id: which of them are to come to rest and which begin where they are,
/// as the scene wants it (fluid.settle). Builds all kernels; throws program::ConfigError for what
/// the scene says wrong, std::runtime_error for the device.
[[nodiscard]] Fluid make_fluid(Device& device, const Scene& scene, const Bodies& bodies,
                               std::vector<SupportState>& support_states);

/// Gives every particle the velocity of the scene's flow; the fastest of them [m/s].
double start_flow(Fluid& fluid, const Scene& scene);

}  // namespace splash::sim
