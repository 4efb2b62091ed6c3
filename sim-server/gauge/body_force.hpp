// SPDX-License-Identifier: MIT
// The force of the water on a body: the sum of what it does to the body's points (body_push.hpp).
#pragma once

#include <span>

#include "sim-server/bodies/body_points.hpp"
#include "sim-server/bodies/body_steps.hpp"
#include "sim-server/bodies/motion/motion.hpp"
#include "sim-server/gauge/water_state.hpp"

namespace splash::sim {

/// `water` has pressures; `points`: of all bodies, those of `owner` count; `state`: that body's.
[[nodiscard]] BodyForce body_force(const WaterState& water, std::span<const BodyPoint> points,
                                   int owner, const BodyState& state);

}  // namespace splash::sim
