// SPDX-License-Identifier: MIT
// How long steps are: the scene's wish, what slower sound pays for, and what load makes of it.
#include "sim-server/scene/step_policy.hpp"

#include <gtest/gtest.h>

#include <algorithm>

#include "sim-server/scene/scene_table.hpp"

namespace splash::sim {
namespace {

FluidSettings with(double factor, PressureKind solver = PressureKind::weakly_compressible) {
  FluidSettings fluid;
  fluid.time_step_factor = factor;
  fluid.solver = solver;
  return fluid;
}

TEST(StepPolicy, StepsAreAsLongAsTheSceneAsksWhereThatIsStable) {
  for (const double factor : {StepPolicy::kLeastFactor, 0.5, 1.0, 1.05}) {
    EXPECT_DOUBLE_EQ(StepPolicy(with(factor)).factor(), factor);
    EXPECT_DOUBLE_EQ(StepPolicy::sound_factor(with(factor)), 1.0);
  }
}

TEST(StepPolicy, LongerStepsAreBoughtWithSlowerSound) {
  const FluidSettings fluid = with(2.0);
  EXPECT_DOUBLE_EQ(StepPolicy::sound_factor(fluid), 1.05 / 2.0);
  EXPECT_DOUBLE_EQ(StepPolicy(fluid).factor(), 1.05) << "the rest comes of the sound";
}

TEST(StepPolicy, ASpeedOfSoundThatTheSceneNamesIsLeftAlone) {
  FluidSettings fluid = with(1.04);
  fluid.sound_speed = 20.0;
  EXPECT_DOUBLE_EQ(StepPolicy(fluid).factor(), 1.04);
}

TEST(StepPolicy, SolversWithoutSoundGetTheWholeFactor) {
  const FluidSettings fluid = with(2.0, PressureKind::grid_projected);
  EXPECT_DOUBLE_EQ(StepPolicy::sound_factor(fluid), 1.0);
  EXPECT_DOUBLE_EQ(StepPolicy(fluid).factor(), 2.0);
}

TEST(StepPolicy, UnderLoadStepsGrowOnlyToWhereTheyAreStable) {
  const auto under_load = [](double factor, PressureKind solver, double stretch) {
    StepPolicy policy(with(factor, solver));
    policy.set_stretch(stretch);
    const double stretched = policy.factor();
    policy.set_stretch(1.0);
    EXPECT_DOUBLE_EQ(policy.factor(), StepPolicy(with(factor, solver)).factor()) << "and back";
    return stretched;
  };
  const auto state = PressureKind::weakly_compressible;
  EXPECT_NEAR(under_load(1.0, state, 9.0), 1.05, 1e-12);
  EXPECT_NEAR(under_load(1.02, state, 9.0), 1.05, 1e-12);
  EXPECT_NEAR(under_load(2.0, state, 9.0), 1.05, 1e-12) << "the scene's own wish";
  EXPECT_NEAR(under_load(0.1, state, 9.0), 0.105, 1e-12) << "a careful scene stays careful";
  const auto grid = PressureKind::grid_projected;
  EXPECT_NEAR(under_load(1.0, grid, 9.0), 2.0, 1e-12);
  EXPECT_NEAR(under_load(1.0, grid, 1.3), 1.3, 1e-12) << "no longer than is needed";
  EXPECT_NEAR(under_load(1.5, grid, 9.0), 2.0, 1e-12);
  EXPECT_NEAR(under_load(0.1, grid, 9.0), 0.2, 1e-12);
}

TEST(StepPolicy, KnowsWhetherASceneMayAskForMoreThanLoadMakes) {
  EXPECT_TRUE(StepPolicy(with(1.0)).scene_may_ask_for_more()) << "bought with slower sound";
  EXPECT_FALSE(StepPolicy(with(2.0)).scene_may_ask_for_more()) << "it did";
  EXPECT_FALSE(StepPolicy(with(1.0, PressureKind::grid_projected)).scene_may_ask_for_more());
}

TEST(StepPolicy, NoFactorIsBeyondTheRangeOfTheTable) {
  const auto fields = fluid_fields();
  const auto row = std::find_if(fields.begin(), fields.end(), [](const auto& field) {
    return field.row.key == "time_step_factor";
  });
  ASSERT_NE(row, fields.end());
  EXPECT_EQ(row->row.min, StepPolicy::kLeastFactor);
  EXPECT_EQ(row->row.max, StepPolicy::kLargestFactor);
  for (const auto solver : {PressureKind::weakly_compressible, PressureKind::grid_projected}) {
    EXPECT_LE(StepPolicy::stable_factor(solver), StepPolicy::kLargestFactor);
    for (int k = 1; k <= 40; ++k) {
      const double factor = std::min(0.05 * k, row->row.max);
      StepPolicy policy(with(factor, solver));
      policy.set_stretch(9.0);
      EXPECT_LE(policy.factor(), StepPolicy::kLargestFactor) << factor;
    }
  }
}

}  // namespace
}  // namespace splash::sim
