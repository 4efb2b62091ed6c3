// SPDX-License-Identifier: MIT
// Each limit of the time step where it is the least, and steps that fill a frame.
#include "sim-server/fluid/time_step.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "sim-server/scene/step_policy.hpp"

namespace splash::sim {
namespace {

FluidParams params() {
  FluidParams p = {};
  p.support = 0.04F;
  p.length = 0.02F;
  p.sound_speed = 15.0F;
  p.viscous = 1.0e-5F;
  p.artificial = 0.03F;
  return p;
}

TEST(TimeStep, AcousticLimit) {
  EXPECT_NEAR(largest_time_step(params(), 0.0, 0.0, 1.0), 0.6 * 0.04 / 15.0, 1.0e-9);
  EXPECT_NEAR(largest_time_step(params(), 5.0, 0.0, 1.0), 0.6 * 0.04 / 20.0, 1.0e-9);
}

TEST(TimeStep, PushLimit) {
  EXPECT_NEAR(largest_time_step(params(), 0.0, 800.0, 1.0), 0.25 * std::sqrt(0.02 / 800.0), 1.0e-9);
}

TEST(TimeStep, ViolenceShortensNoMoreThanFourfold) {
  EXPECT_NEAR(largest_time_step(params(), 0.0, 1.0e9, 1.0), 0.25 * 0.6 * 0.04 / 15.0, 1.0e-9);
}

TEST(TimeStep, ViscousLimit) {
  FluidParams p = params();
  p.viscous = 0.97F;  // 10 nu
  EXPECT_NEAR(largest_time_step(p, 0.0, 0.0, 1.0), 0.125 * 0.02 * 0.02 / 0.1, 1.0e-9);
  EXPECT_LT(largest_time_step(p, 0.0, 0.0, 1.0), largest_time_step(params(), 0.0, 0.0, 1.0));
}

TEST(TimeStep, ViscousLimitIsNotExceededByWhatASceneAsks) {
  FluidParams p = params();
  p.viscous = 0.97F;
  p.spacing = 0.02F;
  EXPECT_NEAR(largest_time_step(p, 0.0, 0.0, 1.02), 1.02 * 0.125 * 0.02 * 0.02 / 0.1, 1.0e-9);
  EXPECT_NEAR(largest_time_step(p, 0.0, 0.0, 2.0), 0.13 * 0.02 * 0.02 / 0.1, 1.0e-9);
}

TEST(TimeStep, FactorScalesIt) {
  EXPECT_NEAR(largest_time_step(params(), 1.0, 10.0, 0.5),
              0.5 * largest_time_step(params(), 1.0, 10.0, 1.0), 1.0e-12);
}

// The health check takes a longer step for a fault: whatever a scene asks for must pass.
TEST(TimeStep, NoSceneMakesItLongerThanTheHealthCheckAllows) {
  for (const int solver : {SPLASH_WEAKLY_COMPRESSIBLE, SPLASH_GRID_PROJECTED}) {
    FluidParams p = params();
    p.solver = solver;
    p.spacing = 0.02F;
    const double bound = longest_possible_step(p);
    for (const double speed : {0.0, 0.5, 5.0}) {
      for (const double acceleration : {0.0, 9.81, 800.0}) {
        EXPECT_LE(largest_time_step(p, speed, acceleration, StepPolicy::kLargestFactor), bound);
      }
    }
    EXPECT_DOUBLE_EQ(largest_time_step(p, 0.0, 0.0, StepPolicy::kLargestFactor), bound)
        << "and no longer than that";
  }
}

TEST(TimeStep, FrameIsTheNearestNumberOfLargestSteps) {
  EXPECT_EQ(steps_of_frame(0.004, 0.001).count, 4);
  EXPECT_EQ(steps_of_frame(0.0044, 0.001).count, 4);
  EXPECT_EQ(steps_of_frame(0.0046, 0.001).count, 5);
  EXPECT_EQ(steps_of_frame(0.0001, 0.001).count, 1);
  EXPECT_EQ(steps_of_frame(0.0046, 0.001).dt, 0.001);
}

}  // namespace
}  // namespace splash::sim
