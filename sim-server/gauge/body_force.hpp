// SPDX-License-Identifier: MIT
// The force of the water on a body: the reaction to what the body's points do to the particles
// around it in kernels/acceleration.cl, summed in double precision.
//   f_b = sum_i sum_b m rho0 V_b (p_i / rho_i^2 - pi_ib) grad W_ib
//   pi_ib = (10 nu v.x + alpha c0 h min(v.x, 0)) / (rho0 (r^2 + 0.01 h^2)), h = H / 2
#pragma once

#include <span>

#include "sim-server/bodies/body_points.hpp"
#include "sim-server/gauge/water_state.hpp"
#include "sim-server/tracking/motion.hpp"

namespace splash::sim {

struct BodyForce {
  Vector3 force = {0.0, 0.0, 0.0};   ///< [N]
  Vector3 torque = {0.0, 0.0, 0.0};  ///< about the body's centre [N m]
};

/// `water` has pressures; `points`: of all bodies, those of `owner` count; `state`: that body's.
[[nodiscard]] BodyForce body_force(const WaterState& water, std::span<const BodyPoint> points,
                                   int owner, const BodyState& state);

}  // namespace splash::sim
