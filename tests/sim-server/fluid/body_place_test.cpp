// SPDX-License-Identifier: MIT
// Body points where a double-precision rotation puts them, for any step of a frame.
#include <gtest/gtest.h>

#include "sim-server/scene/rotation.hpp"
#include "tests/sim-server/fluid/reference.hpp"
#include "tests/sim-server/fluid/situations.hpp"

namespace splash::sim {
namespace {

TEST(BodyPlace, IsTheDoubleRotation) {
  Device device;
  Water water = two_bodies();
  water.start(device);
  // Three steps of a frame, the last is asked for.
  std::vector<BodyStep> frame;
  for (const double t : {0.0, 0.01, 0.02}) {
    const auto steps = water.bodies->at(t);
    frame.insert(frame.end(), steps.begin(), steps.end());
  }
  water.fluid->set_bodies(frame);
  Step step = water.step_at(0.0);
  step.first_body = 4;
  water.fluid->prepare(step);

  const FluidState state = read_state(*water.fluid);
  const auto points = state.body_position.size();
  ASSERT_EQ(points, water.bodies->points().size());
  const std::vector<int> ids = water.fluid->boundary().points().id.read(device, points);
  const double weight = static_cast<double>(state.params.layer_weight / state.params.spacing);
  for (std::size_t i = 0; i < points; ++i) {
    const BodyPoint& point = water.bodies->points()[static_cast<std::size_t>(ids[i])];
    const BodyState body = water.motions[static_cast<std::size_t>(point.owner)](0.02);
    const Vector3 arm = rotate(body.rotation, point.place);
    ASSERT_LT(length(state.body_position[i] - (body.position + arm)), 2.0e-7);
    ASSERT_LT(length(state.body_velocity[i] - (body.velocity + cross(body.spin, arm))), 2.0e-6);
    ASSERT_NEAR(state.body_volume[i], weight * point.volume, 1.0e-6 * point.volume);
  }
}

}  // namespace
}  // namespace splash::sim
