// SPDX-License-Identifier: MIT
// The guard: planted faults are found, and named; a clean state has none.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "sim-server/fluid/params/parts.hpp"
#include "sim-server/scene/rotation.hpp"
#include "tests/sim-server/fluid/reference.hpp"
#include "tests/sim-server/fluid/situations.hpp"

namespace splash::sim {
namespace {

class FluidStatsOf : public ::testing::TestWithParam<int> {
 protected:
  FluidStatsOf() {
    water_.start(device_);
    water_.stir(1.0, 31);
    water_.step(1.0e-4);
  }

  /// Writes `value` as one number of the particle `id`, and looks.
  FluidStats with(int id, std::size_t axis, float value, bool as_velocity) {
    const Snapshot clean = water_.fluid->snapshot();
    change_particles(*water_.fluid, [&](int found, Vector3& place, Vector3& velocity) {
      if (found == id) (as_velocity ? velocity : place)[axis] = static_cast<double>(value);
    });
    const FluidStats stats = water_.fluid->stats();
    water_.fluid->restore(clean);
    return stats;
  }

  Device device_{-1, false, GetParam()};
  Water water_ = crowd();
};

TEST_P(FluidStatsOf, AFaultNamesTheParticle) {
  constexpr float kNaN = std::numeric_limits<float>::quiet_NaN();
  constexpr float kInfinity = std::numeric_limits<float>::infinity();
  for (const float bad : {kNaN, -kNaN, kInfinity, -kInfinity}) {
    for (const bool as_velocity : {false, true}) {
      for (std::size_t axis = 0; axis < 3; ++axis) {
        const int id = 1500 - static_cast<int>(axis);  // the last are easily left out
        const FluidStats stats = with(id, axis, bad, as_velocity);
        EXPECT_EQ(stats.not_finite, 1) << bad;
        EXPECT_EQ(stats.first_bad, id) << bad;
        EXPECT_TRUE(std::isfinite(stats.speed) && std::isfinite(stats.mean_excess));
      }
    }
  }
}

TEST_P(FluidStatsOf, ARunawayCountsIt) {
  EXPECT_EQ(with(5, 1, 14.9F, true).runaway, 1);
  EXPECT_EQ(with(5, 1, 13.0F, true).runaway, 0);
}

TEST_P(FluidStatsOf, ACleanStateHasTheTwinsSpeedsAndExcess) {
  FluidState state;
  water_.step(1.0e-4, [&](Fluid& fluid) { state = read_state(fluid); });
  const std::vector<Vector3> accelerations = read_acceleration(*water_.fluid);
  const FluidStats stats = water_.fluid->stats();
  double speed = 0.0;
  for (const Vector3& v : velocities_of(*water_.fluid)) speed = std::max(speed, length(v));
  double acceleration = 0.0;
  double sum = 0.0;
  double most = 0.0;
  for (std::size_t i = 0; i < state.id.size(); ++i) {
    acceleration = std::max(acceleration, length(accelerations[i]));
    const double rest = static_cast<double>(state.params.rest_density);
    const double excess = std::max(state.density[i] / rest - 1.0, 0.0);
    sum += excess;
    most = std::max(most, excess);
  }
  EXPECT_EQ(stats.not_finite, 0);
  EXPECT_EQ(stats.first_bad, -1);
  EXPECT_EQ(stats.runaway, 0);
  EXPECT_NEAR(stats.speed, speed, 1.0e-6 * speed);
  EXPECT_NEAR(stats.acceleration, acceleration, 1.0e-6 * acceleration);
  EXPECT_GT(most, 0.1);
  EXPECT_NEAR(stats.max_excess, most, 1.0e-6);
  EXPECT_NEAR(stats.mean_excess, sum / static_cast<double>(state.id.size()), 1.0e-6);
}

INSTANTIATE_TEST_SUITE_P(Builds, FluidStatsOf, kScalarAndVector, lanes_name);

}  // namespace
}  // namespace splash::sim
