// SPDX-License-Identifier: MIT
// The looks at the water, after every step and once a frame: sound water has no fault, a planted
// one is found with its particle and its step, with every width of vectors.
#include "sim-server/fluid/health/health.hpp"

#include <gmock/gmock.h>
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

constexpr double kDt = 1.0e-4;  // [s]

class HealthOf : public ::testing::TestWithParam<int> {
 protected:
  HealthOf() {
    water_.start(device_);
    water_.stir(1.0, 31);
    water_.step(kDt);
  }

  /// Three steps, `harm` in the second, between its halves.
  std::optional<Diagnosis> after(const std::function<void(Fluid&)>& harm) {
    Fluid& fluid = *water_.fluid;
    fluid.begin_watch(3);
    for (int k = 0; k < 3; ++k) {
      water_.step(kDt, [&](Fluid& f) {
        if (k == 1) harm(f);
      });
    }
    static_cast<void>(fluid.stats());
    return fluid.health().diagnosis();
  }

  /// Writes one number past the fluid, as broken memory would.
  static void poke(Fluid& fluid, const Buffer<float>& buffer, std::size_t index, float value) {
    fluid.device().queue().enqueueWriteBuffer(buffer.memory(), CL_TRUE, index * sizeof value,
                                              sizeof value, &value);
  }
  static int id_at(Fluid& fluid, std::size_t place) {
    return fluid.particles().id.read(fluid.device(), place + 1).back();
  }

  Device device_{-1, false, GetParam()};
  Water water_ = resting_lattice();
};

TEST_P(HealthOf, AFaultNamesItsParticleAndItsStep) {
  const auto last = static_cast<std::size_t>(water_.params.count) - 1;
  constexpr float kInfinity = std::numeric_limits<float>::infinity();
  for (const std::size_t place : {std::size_t{0}, last / 2, last}) {
    const Snapshot sound = water_.fluid->snapshot();
    int id = -1;
    const auto found = after([&](Fluid& fluid) {
      id = id_at(fluid, place);
      poke(fluid, fluid.density(), place, -kInfinity);
    });
    water_.fluid->restore(sound);
    ASSERT_TRUE(found) << place;
    EXPECT_EQ(found->fault, Fault::not_finite);
    EXPECT_EQ(found->step, 1);
    EXPECT_EQ(found->particle, id);
    EXPECT_EQ(found->particles, 1);
  }
}

TEST_P(HealthOf, AStateThatChangedBetweenStepsIsSeenToTheLastBit) {
  Fluid& fluid = *water_.fluid;
  ASSERT_FALSE(after([](Fluid&) {}));
  fluid.health().accept();
  const float old = fluid.particles().velocity.read(device_, 8).back();
  poke(fluid, fluid.particles().velocity, 7, std::nextafter(old, 100.0F));
  const auto found = after([](Fluid&) {});
  ASSERT_TRUE(found);
  EXPECT_EQ(found->fault, Fault::changed);
  EXPECT_EQ(found->step, 0);
  fluid.health().forget();
  EXPECT_FALSE(after([](Fluid&) {})) << "a state put there on purpose";
}

TEST_P(HealthOf, AStepTooLongIsSeenWhateverCameOfIt) {
  Fluid& fluid = *water_.fluid;
  for (const double dt : {1.0, std::numeric_limits<double>::quiet_NaN()}) {
    const Snapshot sound = fluid.snapshot();
    fluid.begin_watch(1);
    water_.step(dt);
    static_cast<void>(fluid.stats());
    ASSERT_TRUE(fluid.health().diagnosis());
    EXPECT_EQ(fluid.health().diagnosis()->fault, Fault::step);
    fluid.restore(sound);
  }
}

INSTANTIATE_TEST_SUITE_P(Builds, HealthOf, kScalarAndVector, lanes_name);

TEST(HealthWords, EachFaultHasItsOwn) {
  for (std::size_t k = 0; k < kFaults; ++k) {
    EXPECT_THAT(std::string(describe(static_cast<Fault>(k))), testing::Ne("unknown"));
    EXPECT_THAT(std::string(likely_cause(static_cast<Fault>(k))), testing::Ne("unknown"));
  }
}

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
