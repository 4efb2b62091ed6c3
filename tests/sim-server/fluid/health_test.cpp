// SPDX-License-Identifier: MIT
// The look after every step: sound water has no fault, a planted one is found with its particle and
// its step, with every width of vectors.
#include "sim-server/fluid/health/health.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <limits>

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

}  // namespace
}  // namespace splash::sim
