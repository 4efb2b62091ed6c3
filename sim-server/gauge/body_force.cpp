// SPDX-License-Identifier: MIT
#include "sim-server/gauge/body_force.hpp"

#include "sim-server/gauge/body_push.hpp"
#include "sim-server/scene/rotation.hpp"

namespace splash::sim {

BodyForce body_force(const WaterState& water, std::span<const BodyPoint> points, int owner,
                     const BodyState& state) {
  BodyForce total;
  PlacedBody(water, points, owner, state)
      .each_push(water, [&](std::size_t i, const PlacedPoint&, const Vector3& force) {
        total.force = total.force + force;
        total.torque = total.torque + cross(water.position[i] - state.position, force);
      });
  return total;
}

}  // namespace splash::sim
