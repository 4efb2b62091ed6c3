// SPDX-License-Identifier: MIT
// Density, pressure, accelerations and the places of bodies' points against the double-precision
// reference.
#include <gtest/gtest.h>

#include <cmath>
#include <limits>

#include "sim-server/scene/rotation.hpp"
#include "tests/sim-server/fluid/reference.hpp"
#include "tests/sim-server/fluid/situations.hpp"

namespace splash::sim {
namespace {

/// Relative. Measured at most 4.3e-6 with PoCL: tens of float
/// roundings of 6e-8.
constexpr double kDensityBound = 1.0e-5;

class Density : public ::testing::TestWithParam<int> {};

TEST_P(Density, IsTheTwins) {
  Device device(-1, false, GetParam());
  double worst = 0.0;
  for (Water& water : situations()) {
    SCOPED_TRACE(water.name);
    water.start(device);
    water.fluid->set_bodies(water.bodies->at(0.0));
    water.fluid->prepare(water.step_at(0.0));
    const FluidState state = read_state(*water.fluid, water.piston.offset);
    const std::vector<double> reference = reference_density(state);
    const double sound = static_cast<double>(state.params.sound_speed);
    for (std::size_t i = 0; i < reference.size(); ++i) {
      ASSERT_NEAR(state.density[i], reference[i], kDensityBound * reference[i])
          << "particle " << state.id[i];
      worst = std::max(worst, std::abs(state.density[i] / reference[i] - 1.0));
      // The pressure is a small difference of densities: it inherits their absolute error.
      ASSERT_NEAR(state.pressure_term[i],
                  reference_pressure_term(state.params, reference[i], reference[i]),
                  2.0 * kDensityBound * sound * sound / reference[i])
          << "particle " << state.id[i];
    }
  }
  RecordProperty("worst_relative_error", std::to_string(worst));
  std::printf("worst relative error of density: %.2e\n", worst);
}

// A particle that is no number any more must not lead any index astray: those out of its reach
// stay what they were.
TEST_P(Density, OfOthersOutlivesNoNumbers) {
  Device device(-1, false, GetParam());
  for (const float bad : {std::numeric_limits<float>::quiet_NaN(),
                          std::numeric_limits<float>::infinity(), -3.0e38F, 3.0e38F}) {
    SCOPED_TRACE(bad);
    Water water = resting_lattice();
    water.start(device);
    change_particles(*water.fluid, [bad](int id, Vector3& place, Vector3&) {
      for (const int first : {7, 300}) {
        const int axis = id - first;
        if (axis >= 0 && axis < 3) place[static_cast<std::size_t>(axis)] = double{bad};
      }
    });
    water.step(1.0e-4);
    water.step(1.0e-4, [&](Fluid& fluid) {
      const FluidState state = read_state(fluid);
      std::vector<int> seen(state.id.size(), 0);
      for (const int id : state.id) {
        ASSERT_GE(id, 0);
        ASSERT_LT(id, water.params.count);
        EXPECT_EQ(++seen[static_cast<std::size_t>(id)], 1) << "id " << id;
      }
    });
  }
}

INSTANTIATE_TEST_SUITE_P(Builds, Density, kLaneCounts, lanes_name);

/// Relative to the sum of the magnitudes of all pushes on the particle. Measured at most 3.3e-6
/// with PoCL.
constexpr double kAccelerationBound = 2.0e-5;

class Acceleration : public ::testing::TestWithParam<int> {};

TEST_P(Acceleration, IsTheTwins) {
  Device device(-1, false, GetParam());
  double worst = 0.0;
  for (Water& water : situations()) {
    SCOPED_TRACE(water.name);
    water.start(device);
    water.stir(1.0, 7);
    FluidState state;
    water.step(1.0e-4, [&](Fluid& fluid) { state = read_state(fluid, water.piston.offset); });
    const std::vector<Vector3> device_says = read_acceleration(*water.fluid);
    const std::vector<ReferenceAcceleration> reference = reference_acceleration(state);
    for (std::size_t i = 0; i < reference.size(); ++i) {
      const double error = length(device_says[i] - reference[i].value) / reference[i].scale;
      ASSERT_LT(error, kAccelerationBound) << "particle " << state.id[i];
      worst = std::max(worst, error);
    }
  }
  std::printf("worst error of acceleration to its scale: %.2e\n", worst);
}

// The reference alone could share a mistake with the kernel; that pair forces cancel is beyond
// both.
TEST_P(Acceleration, OfAllTogetherIsGravity) {
  Device device(-1, false, GetParam());
  Water water = crowd();
  water.scene.fluid.gravity = {0.0, 0.0, 0.0};
  water.scene.fluid.pull = {0.0, 0.0, 0.0};
  water.start(device);
  FluidParams open = water.params;
  open.wall_count = 0;
  water.fluid = std::make_unique<Fluid>(device, open, water.particles, std::vector<BoundaryPoint>{},
                                        Outlines{});
  water.stir(1.0, 8);
  water.step(1.0e-4);
  Vector3 sum = {0.0, 0.0, 0.0};
  double scale = 0.0;
  for (const Vector3& a : read_acceleration(*water.fluid)) {
    sum = sum + a;
    scale += length(a);
  }
  EXPECT_GT(scale, 1.0);
  EXPECT_LT(length(sum) / scale, 1.0e-6);
}

INSTANTIATE_TEST_SUITE_P(Builds, Acceleration, kLaneCounts, lanes_name);

// For any step of a frame.
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
