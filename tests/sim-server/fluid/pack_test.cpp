// SPDX-License-Identifier: MIT
// Water that hangs free begins as a liquid: without rows, as dense as at rest, where it was.
#include "sim-server/start/settle.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <complex>
#include <numbers>

#include "sim-server/fluid/time_step.hpp"
#include "sim-server/scene/initial_fluid.hpp"
#include "sim-server/scene/rotation.hpp"
#include "tests/sim-server/fluid/small_water.hpp"

namespace splash::sim {
namespace {

constexpr double kSpacing = 0.02;
constexpr Vector3 kMiddle = {0.4, 0.4, 0.5};

/// A ball of ten spacings in radius above a shallow pool, in a tank of 0.8 m.
class Pack : public ::testing::TestWithParam<PressureKind> {
 protected:
  void SetUp() override {
    Scene scene = tank_scene(kSpacing, {0.8, 0.8, 0.8}, 0.1);
    scene.fluid.solver = GetParam();
    pool_ = initial_particles(scene).size();
    scene.water.push_back({{0.2, 0.2, 0.3}, {0.6, 0.6, 0.7}, WaterForm::sphere});
    water_.scene = scene;
    water_.particles = initial_particles(scene);
    water_.start(device_);
    before_ = places_of(*water_.fluid);
    dt_ = largest_time_step(water_.params, 0.0, 9.81, 1.0);
  }

  /// Packs the ball.
  void pack_ball(std::uint32_t seed) {
    std::vector<bool> loose(water_.particles.size(), false);
    for (std::size_t i = pool_; i < loose.size(); ++i) loose[i] = true;
    pack(*water_.fluid, {}, 0.0, dt_, loose, seed);
  }

  /// |sum exp(i k x)| / N over the ball for waves of one spacing along `axis`: 1 on the lattice,
  /// about 1 / sqrt(N) = 0.016 where nothing is in rows.
  double rows(const std::vector<Vector3>& all, std::size_t axis) const {
    std::complex<double> sum = 0.0;
    for (std::size_t i = pool_; i < all.size(); ++i) {
      sum += std::polar(1.0, 2.0 * std::numbers::pi * all[i][axis] / kSpacing);
    }
    return std::abs(sum) / static_cast<double>(all.size() - pool_);
  }

  Device device_;
  Water water_;
  std::size_t pool_ = 0;  ///< particles with smaller ids are the pool's
  std::vector<Vector3> before_;
  double dt_ = 0.0;  ///< [s]
};

TEST_P(Pack, LeavesNoRows) {
  for (std::size_t axis = 0; axis < 3; ++axis) EXPECT_GT(rows(before_, axis), 0.9);
  pack_ball(1);
  const std::vector<Vector3> packed = places_of(*water_.fluid);
  for (std::size_t axis = 0; axis < 3; ++axis) EXPECT_LT(rows(packed, axis), 0.2) << axis;
}

TEST_P(Pack, KeepsTheBallsPlaceAndSize) {
  pack_ball(1);
  const std::vector<Vector3> packed = places_of(*water_.fluid);
  Vector3 moved = {};
  double square = 0.0;
  double square_before = 0.0;
  for (std::size_t i = pool_; i < packed.size(); ++i) {
    moved = moved + (packed[i] - before_[i]);
    const Vector3 from = packed[i] - kMiddle;
    const Vector3 was = before_[i] - kMiddle;
    square += dot(from, from);
    square_before += dot(was, was);
    EXPECT_LT(length(packed[i] - before_[i]), 1.5 * kSpacing);
  }
  const auto count = static_cast<double>(packed.size() - pool_);
  EXPECT_LT(length((1.0 / count) * moved), 0.02 * kSpacing);
  EXPECT_NEAR(std::sqrt(square / square_before), 1.0, 0.02);  // of ten spacings
}

TEST_P(Pack, LeavesItAsDenseAsAtRest) {
  pack_ball(1);
  water_.fluid->prepare(water_.step_at(dt_));
  const std::vector<float> density = water_.fluid->density().read(device_, water_.particles.size());
  const Snapshot now = water_.fluid->snapshot();
  double most = 0.0;
  double inner = 0.0;
  int count = 0;
  for (std::size_t i = 0; i < density.size(); ++i) {
    if (static_cast<std::size_t>(now.id[i]) < pool_) continue;
    const double excess = static_cast<double>(density[i] / water_.params.rest_density) - 1.0;
    most = std::max(most, excess);
    if (length(now.place(i) - kMiddle) > 0.12) continue;
    inner += excess;
    ++count;
  }
  // Pressure pushes and never pulls, so it ends where the densest are as dense as at rest.
  EXPECT_LT(most, 0.01);
  EXPECT_NEAR(inner / count, 0.0, 0.02);
}

TEST_P(Pack, MovesNothingElse) {
  pack_ball(1);
  const std::vector<Vector3> packed = places_of(*water_.fluid);
  for (std::size_t i = 0; i < pool_; ++i) ASSERT_EQ(packed[i], before_[i]) << i;
}

TEST_P(Pack, EndsAtRestAndWithWeight) {
  pack_ball(1);
  for (const Vector3& v : velocities_of(*water_.fluid)) ASSERT_EQ(v, (Vector3{0.0, 0.0, 0.0}));
  water_.step(dt_);
  Vector3 mean = {};
  const std::vector<Vector3> falling = velocities_of(*water_.fluid);
  for (std::size_t i = pool_; i < falling.size(); ++i) mean = mean + falling[i];
  const auto count = static_cast<double>(falling.size() - pool_);
  EXPECT_NEAR(mean[2] / count, -9.81 * dt_, 1e-4 * 9.81 * dt_);
}

TEST_P(Pack, IsTheSameForTheSameSeed) {
  pack_ball(7);
  const std::vector<Vector3> first = places_of(*water_.fluid);
  for (const std::uint32_t seed : {7U, 8U}) {
    water_.start(device_);
    pack_ball(seed);
    EXPECT_EQ(places_of(*water_.fluid) == first, seed == 7U);
  }
}

TEST_P(Pack, DoesNothingWhereNothingIsLoose) {
  pack(*water_.fluid, {}, 0.0, dt_, std::vector<bool>(water_.particles.size(), false), 1);
  EXPECT_EQ(places_of(*water_.fluid), before_);
}

INSTANTIATE_TEST_SUITE_P(Each, Pack, kBothSolvers, solver_name);

}  // namespace
}  // namespace splash::sim
