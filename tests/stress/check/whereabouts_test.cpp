// SPDX-License-Identifier: MIT
// What the trials know of places is right: a particle in a body and water that has risen are seen.
#include "tests/stress/whereabouts.hpp"

#include <gtest/gtest.h>

#include "tests/stress/trial_parts.hpp"

namespace splash::stress {
namespace {

constexpr double kRadius = 0.06;  // of the ball [m]

sim::Scene still() {
  sim::Scene scene = with(basin(0.05), {ball({0.2, 0.2, 0.12}, 2.0 * kRadius)});
  scene.fluid.settle = sim::SettleKind::never;
  return scene;
}

TEST(Whereabouts, AreThoseOfWaterThatIsWhereItShouldBe) {
  sim::Device device;
  sim::Simulation simulation(device, still(), {});
  EXPECT_TRUE(nobody_lost(simulation));
  EXPECT_EQ(deepest_inside(simulation), 0.0);
  EXPECT_NEAR(mean_height(simulation), 0.1, 0.01);
}

TEST(Whereabouts, TellHowDeepAParticleIsInABody) {
  sim::Device device;
  sim::Simulation simulation(device, still(), {});
  const sim::Vector3 within = {0.2, 0.23, 0.12};
  sim::Snapshot water = simulation.fluid().snapshot();
  const auto stride = static_cast<std::size_t>(simulation.fluid().params().capacity);
  for (std::size_t axis = 0; axis < 3; ++axis) {
    water.position[axis * stride + 7] = static_cast<float>(within[axis]);
  }
  simulation.fluid().restore(water);
  EXPECT_NEAR(deepest_inside(simulation), kRadius - 0.03, 1.0e-6);
}

TEST(Whereabouts, TellThatWaterHasRisenOrIsLost) {
  sim::Device device;
  sim::Simulation simulation(device, still(), {});
  const double before = mean_height(simulation);
  sim::Snapshot water = simulation.fluid().snapshot();
  const auto stride = static_cast<std::size_t>(simulation.fluid().params().capacity);
  for (std::size_t i = 0; i < water.id.size(); ++i) water.position[2 * stride + i] += 0.02F;
  simulation.fluid().restore(water);
  EXPECT_NEAR(mean_height(simulation), before + 0.02, 1.0e-6);
  EXPECT_TRUE(nobody_lost(simulation));
  water.id[3] = water.id[4];
  simulation.fluid().restore(water);
  EXPECT_FALSE(nobody_lost(simulation));
}

}  // namespace
}  // namespace splash::stress
