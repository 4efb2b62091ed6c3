// SPDX-License-Identifier: MIT
// Live poses: followed without jumps, refused when they cannot be, brought to rest when they stop.
#include "sim-server/tracking/live_motion.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <random>
#include <thread>

#include "tests/sim-server/tracking/motion_checks.hpp"

namespace splash::sim {
namespace {

constexpr double kNan = std::numeric_limits<double>::quiet_NaN();
constexpr double kInfinity = std::numeric_limits<double>::infinity();
const Quaternion kUpright = {0.0, 0.0, 0.0, 1.0};
const Keyframe kRest = {0.0, {0.0, 0.0, 1.0}, kUpright};

/// 60 poses a second of a swing of 10 cm at 1 Hz, with up to 2 ms of jitter on their way.
void swing(LiveMotion& motion, double until) {
  std::mt19937 random(3);
  std::uniform_real_distribution<double> jitter(0.0, 0.002);
  for (int i = 0; i < static_cast<int>(until * 60.0); ++i) {
    const double t = i / 60.0;
    const Vector3 place = {0.1 * std::sin(2 * M_PI * t), 0.0, 1.0};
    EXPECT_EQ(
        motion.push(place, from_turn({0.0, 0.5 * std::sin(2 * M_PI * t), 0.0}), t + jitter(random)),
        PoseRefusal::none);
  }
}

TEST(LiveMotion, WaitsAtRest) {
  const LiveMotion motion(kRest);
  for (const double t : {-1.0, 0.0, 100.0, kNan, kInfinity}) {
    EXPECT_EQ(motion.at(t).position, kRest.position);
    EXPECT_EQ(length(motion.at(t).velocity), 0.0);
  }
}

TEST(LiveMotion, FollowsASwing) {
  LiveMotion motion(kRest);
  swing(motion, 2.0);
  for (double t = 0.2; t < 1.9; t += 0.003) {
    const BodyState state = motion.at(t);
    EXPECT_NEAR(state.position[0], 0.1 * std::sin(2 * M_PI * t), 0.006);
    EXPECT_NEAR(state.velocity[0], 0.2 * M_PI * std::cos(2 * M_PI * t), 0.25);
  }
}

TEST(LiveMotion, NeverJumpsAndItsVelocitiesAreTheDerivatives) {
  LiveMotion motion(kRest);
  swing(motion, 2.0);
  BodyState before = motion.at(0.1);
  for (double t = 0.1; t < 2.2; t += 0.0005) {
    const BodyState state = motion.at(t);
    EXPECT_LT(length(state.position - before.position), 0.0005 * 1.2) << t;
    before = state;
  }
  // Between arrivals; at one the velocity may have a corner.
  int corners = 0;
  for (double t = 0.1007; t < 2.2; t += 0.0137) {
    const BodyState a = motion.at(t - 1e-6);
    const BodyState b = motion.at(t + 1e-6);
    if (length(a.velocity - b.velocity) > 0.01) {
      ++corners;
      continue;
    }
    expect_consistent(motion, t, 1e-3);
  }
  EXPECT_LT(corners, 3);
}

TEST(LiveMotion, ComesToRestWithoutPoses) {
  LiveMotion motion(kRest);
  for (int i = 0; i < 30; ++i) {
    motion.push({i / 60.0, 0.0, 1.0}, from_turn({0.0, 0.0, i / 60.0}), i / 60.0);
  }
  const double last = 29 / 60.0;
  EXPECT_NEAR(motion.at(last + 0.02).velocity[0], 1.0, 0.01) << "one late pose is no stop";
  const BodyState later = motion.at(last + 0.1);
  EXPECT_EQ(length(later.velocity), 0.0);
  EXPECT_EQ(length(later.spin), 0.0);
  EXPECT_LT(later.position[0], last + 0.06) << "it does not run away";
  EXPECT_LT(length(motion.at(1e9).position - later.position), 1e-12);
}

/// 1 m/s in poses 1/60 s apart, the last at 29/60 s.
void walk(LiveMotion& motion) {
  for (int i = 0; i < 30; ++i) motion.push({i / 60.0, 0.0, 1.0}, kUpright, i / 60.0);
}

TEST(LiveMotion, BridgesAGapForAsLongAsItMay) {
  LiveMotion motion(kRest, {}, {.coast = 0.2});
  walk(motion);
  const double last = 29 / 60.0;
  EXPECT_NEAR(motion.at(last + 0.2).velocity[0], 1.0, 0.01);
  EXPECT_NEAR(motion.at(last + 0.2).position[0], last + 0.2, 0.003);
  const BodyState later = motion.at(last + 0.3);
  EXPECT_EQ(length(later.velocity), 0.0);
  EXPECT_NEAR(later.position[0], last + 0.2 + 0.025, 0.003) << "half the speed while it stops";
}

TEST(LiveMotion, HoldsAGapAtTheLastPose) {
  LiveMotion motion(kRest, {}, {.coast = 0.0, .fade = 0.0});
  walk(motion);
  const double last = 29 / 60.0;
  EXPECT_NEAR(motion.at(last + 0.05).position[0], last, 1.0e-9);
  EXPECT_NEAR(motion.at(last + 5.0).position[0], last, 1.0e-12) << "and never beyond it";
  EXPECT_EQ(length(motion.at(last + 0.05).velocity), 0.0);
  // The next pose is not jumped to.
  motion.push({last + 0.1, 0.0, 1.0}, kUpright, last + 0.1);
  EXPECT_NEAR(motion.at(last + 0.1).position[0], last, 1.0e-9);
  EXPECT_NEAR(motion.at(last + 0.14).position[0], last + 0.1, 1.0e-9);
}

TEST(LiveMotion, AppearsAtOnceWhereItIsFoundFirstOrFarAway) {
  LiveMotion motion(kRest);
  motion.push({5.0, 5.0, 2.0}, kUpright, 1.0);
  EXPECT_LT(length(motion.at(1.0).position - Vector3{5.0, 5.0, 2.0}), 1e-12);
  motion.push({-5.0, 5.0, 2.0}, kUpright, 9.0);
  EXPECT_LT(length(motion.at(9.0).position - Vector3{-5.0, 5.0, 2.0}), 1e-12);
  EXPECT_LT(length(motion.at(9.0).velocity), 1e-12) << "not flung there";
}

TEST(LiveMotion, RefusesWhatIsNoPose) {
  LiveMotion motion(kRest);
  ASSERT_EQ(motion.push({0.0, 0.0, 1.0}, kUpright, 1.0), PoseRefusal::none);
  const auto push = [&](const Vector3& place, const Quaternion& turn, double t) {
    return motion.push(place, turn, t);
  };
  EXPECT_EQ(push({kNan, 0.0, 1.0}, kUpright, 2.0), PoseRefusal::not_finite);
  EXPECT_EQ(push({0.0, kInfinity, 1.0}, kUpright, 2.0), PoseRefusal::not_finite);
  EXPECT_EQ(push({0.0, 0.0, 1.0}, {0.0, kNan, 0.0, 1.0}, 2.0), PoseRefusal::not_finite);
  EXPECT_EQ(push({0.0, 0.0, 1.0}, kUpright, kNan), PoseRefusal::not_finite);
  EXPECT_EQ(push({0.0, 0.0, 1.0}, {0.0, 0.0, 0.0, 0.0}, 2.0), PoseRefusal::no_rotation);
  EXPECT_EQ(push({0.0, 0.0, 101.0}, kUpright, 2.0), PoseRefusal::too_far);
  EXPECT_EQ(push({0.0, 0.0, 1.0}, kUpright, 0.9), PoseRefusal::time_ran_back);
  EXPECT_EQ(push({0.0, 0.0, 2.0}, kUpright, 1.02), PoseRefusal::too_fast) << "1 m in 20 ms";
  EXPECT_EQ(push({0.0, 0.0, 1.0}, {0.0, 0.0, 1.0, 0.0}, 1.02), PoseRefusal::too_fast);
  EXPECT_EQ(motion.at(5.0).position, kRest.position) << "nothing of it was taken";
  EXPECT_EQ(push({0.0, 0.0, 2.0}, kUpright, 2.0), PoseRefusal::none) << "in time it may";
  EXPECT_EQ(describe(PoseRefusal::too_fast), "the speed is beyond the limit");
}

TEST(LiveMotion, NormalisesQuaternions) {
  LiveMotion motion(kRest);
  motion.push({0.0, 0.0, 1.0}, {0.0, 0.0, 3.0, 3.0}, 1.0);
  EXPECT_NEAR(motion.at(1.0).rotation[3], std::sqrt(0.5), 1e-12);
}

TEST(LiveMotion, TwoPosesInOneInstantAreTheLaterOne) {
  LiveMotion motion(kRest);
  motion.push({0.0, 0.0, 1.0}, kUpright, 1.0);
  EXPECT_EQ(motion.push({0.01, 0.0, 1.0}, kUpright, 1.0), PoseRefusal::none);
  EXPECT_NEAR(motion.at(1.2).position[0], 0.01, 1e-12);
}

TEST(LiveMotion, MayBeReadWhileItIsWritten) {
  LiveMotion motion(kRest);
  std::thread writer([&] {
    for (int i = 0; i < 5000; ++i) {
      motion.push({0.0, 0.0, 1.0 + 1e-4 * (i % 2)}, kUpright, i * 0.001);
    }
  });
  for (int i = 0; i < 5000; ++i) {
    EXPECT_TRUE(std::isfinite(motion.at(i * 0.001).position[2]));
  }
  writer.join();
}

}  // namespace
}  // namespace splash::sim
