// SPDX-License-Identifier: MIT
// Accelerations against the double-precision reference.
#include <gtest/gtest.h>

#include <cmath>

#include "sim-server/scene/rotation.hpp"
#include "tests/sim-server/fluid/reference.hpp"
#include "tests/sim-server/fluid/situations.hpp"

namespace splash::sim {
namespace {

/// Relative to the sum of the magnitudes of all pushes on the particle. Measured at most 3.3e-6
/// with PoCL.
constexpr double kBound = 2.0e-5;

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
      ASSERT_LT(error, kBound) << "particle " << state.id[i];
      worst = std::max(worst, error);
    }
  }
  std::printf("worst error of acceleration to its scale: %.2e\n", worst);
}

// The reference alone could share a mistake with the kernel; that pair forces cancel is beyond
// both.
TEST_P(Acceleration, OfAllTogetherIsGravity) {
  Device device(-1, false, GetParam());
  std::vector<Water> all = situations();
  Water& water = all.at(1);
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

}  // namespace
}  // namespace splash::sim
