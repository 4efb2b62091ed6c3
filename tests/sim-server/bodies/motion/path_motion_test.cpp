// SPDX-License-Identifier: MIT
// Paths: through their poses, velocities true to them, no overshoot, still at the ends.
#include "sim-server/bodies/motion/path_motion.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "tests/sim-server/bodies/motion/motion_checks.hpp"

namespace splash::sim {
namespace {

std::vector<Keyframe> poses() {
  return {{0.0, {0.0, 0.0, 1.0}, from_turn({0.0, 0.0, 0.0})},
          {0.4, {0.2, 0.0, 0.5}, from_turn({0.5, 0.2, 0.0})},
          {1.0, {0.2, 0.3, 0.5}, from_turn({0.5, 1.2, -0.4})},
          {1.1, {0.3, 0.3, 0.4}, from_turn({0.9, 1.2, 0.4})},
          {2.0, {0.1, 0.1, 1.2}, from_turn({0.0, 0.0, 2.0})}};
}

std::string name_of(const ::testing::TestParamInfo<Between>& between) {
  if (between.param == Between::straight) return "straight";
  return between.param == Between::monotone ? "monotone" : "through";
}

class EveryPath : public ::testing::TestWithParam<Between> {};

TEST_P(EveryPath, GoesThroughItsPoses) {
  const PathMotion path(poses(), GetParam());
  for (const Keyframe& pose : poses()) {
    const BodyState state = path.at(pose.time);
    EXPECT_LT(length(state.position - pose.position), 1e-12);
    EXPECT_LT(length(to_turn(compose(state.rotation, inverse(pose.rotation)))), 1e-9);
  }
}

TEST_P(EveryPath, TellsItsLargestSpeedBeforehand) {
  for (const double start : {0.0, 1.2}) {
    const PathMotion path(poses(), GetParam(), false, start);
    double largest = 0.0;
    for (double t = 0.0; t < 2.0 - start; t += 0.0007) {
      largest = std::max(largest, length(path.at(t).velocity));
    }
    EXPECT_LE(largest, 1.07 * path.fastest());
    EXPECT_GE(largest, 0.99 * path.fastest() - (start > 0.0 ? 0.6 : 0.0));
  }
}

TEST_P(EveryPath, VelocitiesAreTheDerivatives) {
  const PathMotion path(poses(), GetParam());
  for (double t = 0.013; t < 2.0; t += 0.0371) expect_consistent(path, t, 2e-4);
}

TEST_P(EveryPath, StandsStillBeforeAndAfter) {
  const PathMotion path(poses(), GetParam());
  for (const double t : {-1e9, -0.1, 2.0001, 1e12}) {
    const BodyState state = path.at(t);
    const Keyframe end = t < 0.0 ? poses().front() : poses().back();
    EXPECT_LT(length(state.position - end.position), 1e-12);
    EXPECT_EQ(length(state.velocity) + length(state.spin), 0.0);
  }
}

INSTANTIATE_TEST_SUITE_P(All, EveryPath,
                         ::testing::Values(Between::straight, Between::monotone, Between::through),
                         name_of);

class CubicPath : public ::testing::TestWithParam<Between> {};

TEST_P(CubicPath, HasNoCornerAtItsPoses) {
  const PathMotion path(poses(), GetParam());
  for (std::size_t i = 1; i + 1 < poses().size(); ++i) {
    const double t = poses()[i].time;
    EXPECT_LT(length(path.at(t + 1e-9).velocity - path.at(t - 1e-9).velocity), 1e-4);
    EXPECT_LT(length(path.at(t + 1e-9).spin - path.at(t - 1e-9).spin), 1e-4);
  }
}

INSTANTIATE_TEST_SUITE_P(All, CubicPath, ::testing::Values(Between::monotone, Between::through),
                         name_of);

TEST(PathMotion, MonotoneNeverOvershoots) {
  const PathMotion path(poses(), Between::monotone);
  for (std::size_t i = 0; i + 1 < poses().size(); ++i) {
    const Keyframe a = poses()[i];
    const Keyframe b = poses()[i + 1];
    for (double t = a.time; t < b.time; t += 0.003) {
      const Vector3 p = path.at(t).position;
      for (std::size_t k = 0; k < 3; ++k) {
        EXPECT_GE(p[k], std::min(a.position[k], b.position[k]) - 1e-12);
        EXPECT_LE(p[k], std::max(a.position[k], b.position[k]) + 1e-12);
      }
    }
  }
}

TEST(PathMotion, StraightKeepsItsSpeedExactly) {
  const PathMotion path({{1.0, {0, 0, 0.5}, {0, 0, 0, 1}}, {1.4, {0, 0, 0.1}, {0, 0, 0, 1}}},
                        Between::straight);
  for (double t = 1.0; t < 1.39; t += 0.01) EXPECT_NEAR(path.at(t).velocity[2], -1.0, 1e-12);
}

TEST(PathMotion, ThroughFollowsASampledSineClosely) {
  // 60 Hz samples of 10 cm at 1 Hz: the speed peaks at 0.628 m/s.
  std::vector<Keyframe> samples;
  for (int i = 0; i <= 120; ++i) {
    const double t = i / 60.0;
    samples.push_back({t, {0.1 * std::sin(2 * M_PI * t), 0, 0}, {0, 0, 0, 1}});
  }
  const PathMotion path(samples, Between::through);
  for (double t = 0.1; t < 1.9; t += 0.0043) {
    EXPECT_NEAR(path.at(t).position[0], 0.1 * std::sin(2 * M_PI * t), 1e-5);
    EXPECT_NEAR(path.at(t).velocity[0], 0.2 * M_PI * std::cos(2 * M_PI * t), 5e-3);
  }
}

TEST(PathMotion, RepeatsWithoutASeam) {
  auto closed = poses();
  closed.push_back({2.5, closed.front().position, closed.front().rotation});
  const PathMotion path(closed, Between::through, true);
  for (const double t : {0.2, 1.3, 2.4}) {
    EXPECT_LT(length(path.at(t).position - path.at(t + 2.5).position), 1e-12);
    EXPECT_LT(length(path.at(t).position - path.at(t + 2500.0).position), 1e-9);
  }
  EXPECT_LT(length(path.at(2.5 - 1e-9).velocity - path.at(2.5 + 1e-9).velocity), 1e-4);
}

TEST(PathMotion, RefusesToJump) {
  EXPECT_THROW(PathMotion(poses(), Between::through, true), std::invalid_argument);
  EXPECT_NO_THROW(PathMotion(poses(), Between::through, false));
}

TEST(PathMotion, StartSkips) {
  const PathMotion path(poses(), Between::through, false, 1.0);
  EXPECT_LT(length(path.at(0.0).position - poses()[2].position), 1e-12);
  EXPECT_THROW(PathMotion(poses(), Between::through, false, 2.0), std::invalid_argument);
}

TEST(PathMotion, RefusesWhatIsNoPath) {
  EXPECT_THROW(PathMotion({}, Between::straight), std::invalid_argument);
  auto backwards = poses();
  backwards[2].time = 0.4;
  EXPECT_THROW(PathMotion(backwards, Between::straight), std::invalid_argument);
}

}  // namespace
}  // namespace splash::sim
