// SPDX-License-Identifier: MIT
// Live poses: followed without jumps, refused when they cannot be, brought to rest when they stop.
#include "sim-server/bodies/motion/live_motion.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <limits>
#include <numbers>
#include <thread>

#include "tests/sim-server/bodies/motion/live_play.hpp"
#include "tests/sim-server/bodies/motion/motion_checks.hpp"

namespace splash::sim {
namespace {

constexpr double kNan = std::numeric_limits<double>::quiet_NaN();
constexpr double kInfinity = std::numeric_limits<double>::infinity();
constexpr double kFrame = LivePlay::kFrame;
const Quaternion kUpright = {0.0, 0.0, 0.0, 1.0};
const Keyframe kRest = {0.0, {0.0, 0.0, 1.0}, kUpright};

/// 10 cm at 1 Hz.
Vector3 swing(double t) {
  return {0.1 * std::sin(2 * M_PI * t), 0.0, 1.0};
}

/// What `motion` is at our clock, a frame of which begins there.
BodyState at(LiveMotion& motion, double wall) {
  motion.begin({wall, wall, kFrame});
  return motion.at(wall);
}

/// All that came by our clock until now.
PoseRefusal push(LiveMotion& motion, const Vector3& place, const Quaternion& turn, double arrival) {
  return motion.push(place, turn, {arrival, {}});
}

TEST(LiveMotion, WaitsAtRest) {
  LiveMotion motion(kRest);
  motion.begin({0.0, 1000.0, kFrame});
  for (const double t : {-1.0, 0.0, 100.0, kNan, kInfinity}) {
    EXPECT_EQ(motion.at(t).position, kRest.position);
    EXPECT_EQ(length(motion.at(t).velocity), 0.0);
  }
}

TEST(LiveMotion, FollowsASwing) {
  SentPoses poses = sent_by({.rate = 60.0, .jitter = 0.002}, swing);
  for (SentPose& pose : poses) {
    pose.rotation = from_turn({0.0, 0.5 * std::sin(2 * M_PI * pose.taken), 0.0});
  }
  for (const PlayedState& frame : LivePlay(kRest).play(poses, 1.9)) {
    const double t = frame.wall + 0.5 * kFrame;
    if (t < 0.3) continue;
    EXPECT_NEAR(frame.state.position[0], swing(t)[0], 0.004) << t;
    EXPECT_NEAR(frame.state.velocity[0], 0.2 * M_PI * std::cos(2 * M_PI * t), 0.11) << t;
    EXPECT_NEAR(frame.state.spin[1], M_PI * std::cos(2 * M_PI * t), 0.5) << t;
  }
}

TEST(LiveMotion, NeverJumpsAndItsVelocitiesAreTheDerivatives) {
  LiveMotion motion(kRest);
  const SentPoses poses = sent_by({.rate = 60.0, .jitter = 0.002}, swing);
  std::size_t next = 0;
  BodyState before;
  for (double wall = 0.0; wall < 2.3; wall += kFrame) {
    for (; next < poses.size() && poses[next].arrival <= wall; ++next) {
      EXPECT_EQ(push(motion, poses[next].position, kUpright, poses[next].arrival),
                PoseRefusal::none);
    }
    motion.begin({wall, wall, kFrame});
    if (wall > 0.1) {
      EXPECT_LT(length(motion.at(wall).position - before.position), 1e-12) << wall;
    }
    const double middle = wall + 0.5 * kFrame;
    // But for what is wrong by a millimetre or two, and fades out.
    if (wall > 0.3) expect_consistent(motion, middle, 0.2);
    before = motion.at(wall + kFrame);
  }
}

TEST(LiveMotion, ComesToRestWithoutPoses) {
  LiveMotion motion(kRest);
  for (int i = 0; i < 30; ++i) {
    push(motion, {i / 60.0, 0.0, 1.0}, from_turn({0.0, 0.0, i / 60.0}), i / 60.0);
  }
  const double last = 29 / 60.0;
  EXPECT_NEAR(at(motion, last + 0.02).velocity[0], 1.0, 0.01) << "one late pose is no stop";
  const BodyState later = at(motion, last + 0.1);
  EXPECT_EQ(length(later.velocity), 0.0);
  EXPECT_EQ(length(later.spin), 0.0);
  EXPECT_LT(later.position[0], last + 0.07) << "it does not run away";
  EXPECT_LT(length(at(motion, 1e9).position - later.position), 1e-3);
}

/// 1 m/s in poses 1/60 s apart, the last at 29/60 s.
void walk(LiveMotion& motion) {
  for (int i = 0; i < 30; ++i) push(motion, {i / 60.0, 0.0, 1.0}, kUpright, i / 60.0);
}

TEST(LiveMotion, BridgesAGapForAsLongAsItMay) {
  LiveMotion motion(kRest, {}, {.coast = 0.2});
  walk(motion);
  const double last = 29 / 60.0;
  EXPECT_NEAR(at(motion, last + 0.19).velocity[0], 1.0, 0.01);
  EXPECT_NEAR(at(motion, last + 0.19).position[0], last + 0.19, 0.003);
  const BodyState later = at(motion, last + 0.3);
  EXPECT_EQ(length(later.velocity), 0.0);
  EXPECT_NEAR(later.position[0], last + 0.2 + 0.025, 0.003) << "half the speed while it stops";
}

// At 60 poses a second by radio one is lost now and then: the hand goes on, and the next pose
// finds it where it is.
TEST(LiveMotion, ALostPoseAtSixtyHertzIsNoJolt) {
  const auto fast_swing = [](double t) {
    return Vector3{0.2 * std::sin(2.0 * std::numbers::pi * t), 0.0, 0.3};  // 1.26 m/s, 7.9 m/s2
  };
  const SentPoses all = sent_by({.rate = 60.0, .until = 3.0}, fast_swing);
  const Keyframe rest = {0.0, fast_swing(0.0), kUpright};
  const auto wanted = LivePlay(rest).play(all, 3.0);
  double astray = 0.0;
  double slower = 0.0;
  for (std::size_t lost = 70; lost < 130; ++lost) {
    SentPoses some = all;
    some.erase(some.begin() + static_cast<std::ptrdiff_t>(lost));
    LivePlay play(rest);
    const auto played = play.play(some, 3.0);
    EXPECT_EQ(play.refused(), 0);
    for (std::size_t k = 0; k < played.size(); ++k) {
      astray = std::max(astray, length(played[k].state.position - wanted[k].state.position));
      slower = std::max(slower, length(played[k].state.velocity - wanted[k].state.velocity));
    }
  }
  std::printf("a lost pose: %.1f mm and %.2f m/s off\n", 1e3 * astray, slower);
  EXPECT_LT(astray, 0.005);
  EXPECT_LT(slower, 0.25);
}

/// That poses of a steady motion, `rate` a second, are played at its speed `from` then on [s].
void expect_steady(double rate, const LiveGap& gap, double from) {
  const auto steady = [](double t) { return Vector3{t, 0.0, 1.0}; };
  LivePlay play(kRest, 0.0, gap);
  for (const PlayedState& frame : play.play(sent_by({.rate = rate}, steady), 1.9)) {
    if (frame.wall < from) continue;
    EXPECT_NEAR(frame.state.velocity[0], 1.0, 0.02) << frame.wall;
  }
}

// At 30 Hz 25 ms are less than the time between two poses.
TEST(LiveMotion, DoesNotStopBetweenSlowPoses) {
  expect_steady(30.0, {}, 0.2);
}

constexpr LiveGap kHeld = {.coast = 0.0, .fade = 0.0, .hold = true};

TEST(LiveMotion, HoldsAGapAtTheLastPose) {
  LiveMotion motion(kRest, {}, kHeld);
  walk(motion);
  const double last = 29 / 60.0;
  EXPECT_NEAR(at(motion, last + 0.1).position[0], last, 1.0e-3);
  EXPECT_NEAR(at(motion, last + 5.0).position[0], last, 1.0e-3) << "and never beyond it";
  EXPECT_EQ(length(at(motion, last + 5.0).velocity), 0.0);
}

TEST(LiveMotion, HeldBodiesMoveAtTheirSpeedBetweenPoses) {
  expect_steady(60.0, kHeld, 0.6);
}

TEST(LiveMotion, AppearsAtOnceWhereItIsFoundFirstOrFarAway) {
  LiveMotion motion(kRest);
  push(motion, {5.0, 5.0, 2.0}, kUpright, 1.0);
  EXPECT_LT(length(at(motion, 1.0).position - Vector3{5.0, 5.0, 2.0}), 1e-9);
  push(motion, {-5.0, 5.0, 2.0}, kUpright, 9.0);
  EXPECT_LT(length(at(motion, 9.0).position - Vector3{-5.0, 5.0, 2.0}), 1e-9);
  EXPECT_LT(length(at(motion, 9.0).velocity), 1e-9) << "not flung there";
}

TEST(LiveMotion, RefusesWhatIsNoPose) {
  LiveMotion motion(kRest);
  ASSERT_EQ(push(motion, {0.0, 0.0, 1.0}, kUpright, 1.0), PoseRefusal::none);
  const auto refusal = [&](const Vector3& place, const Quaternion& turn, double t) {
    return push(motion, place, turn, t);
  };
  EXPECT_EQ(refusal({kNan, 0.0, 1.0}, kUpright, 1.1), PoseRefusal::not_finite);
  EXPECT_EQ(refusal({0.0, kInfinity, 1.0}, kUpright, 1.1), PoseRefusal::not_finite);
  EXPECT_EQ(refusal({0.0, 0.0, 1.0}, {0.0, kNan, 0.0, 1.0}, 1.1), PoseRefusal::not_finite);
  EXPECT_EQ(refusal({0.0, 0.0, 1.0}, kUpright, kNan), PoseRefusal::not_finite);
  EXPECT_EQ(motion.push({0.0, 0.0, 1.0}, kUpright, {1.1, kNan}), PoseRefusal::not_finite);
  EXPECT_EQ(refusal({0.0, 0.0, 1.0}, {0.0, 0.0, 0.0, 0.0}, 1.1), PoseRefusal::no_rotation);
  EXPECT_EQ(refusal({0.0, 0.0, 101.0}, kUpright, 1.1), PoseRefusal::too_far);
  EXPECT_EQ(refusal({0.0, 0.0, 1.0}, kUpright, 0.9), PoseRefusal::time_ran_back);
  EXPECT_EQ(refusal({0.0, 0.0, 2.0}, kUpright, 1.02), PoseRefusal::too_fast) << "1 m in 20 ms";
  EXPECT_EQ(refusal({0.0, 0.0, 1.0}, {0.0, 0.0, 1.0, 0.0}, 1.02), PoseRefusal::too_fast);
  EXPECT_EQ(at(motion, 5.0).position, kRest.position) << "nothing of it was taken";
  EXPECT_EQ(refusal({0.0, 0.0, 2.0}, kUpright, 2.0), PoseRefusal::none) << "in time it may";
  EXPECT_EQ(describe(PoseRefusal::too_fast), "the speed is beyond the limit");
}

TEST(LiveMotion, NormalisesQuaternions) {
  LiveMotion motion(kRest);
  push(motion, {0.0, 0.0, 1.0}, {0.0, 0.0, 3.0, 3.0}, 1.0);
  EXPECT_NEAR(at(motion, 1.0).rotation[3], std::sqrt(0.5), 1e-12);
}

TEST(LiveMotion, TwoPosesInOneInstantAreTheLaterOne) {
  LiveMotion motion(kRest);
  push(motion, {0.0, 0.0, 1.0}, kUpright, 1.0);
  EXPECT_EQ(push(motion, {0.01, 0.0, 1.0}, kUpright, 1.0), PoseRefusal::none);
  EXPECT_NEAR(at(motion, 1.2).position[0], 0.01, 1e-12);
}

// What a network held up comes in a heap, and says nothing about a speed.
TEST(LiveMotion, AHeapOfPosesIsTheLastOfThem) {
  LiveMotion motion(kRest);
  for (int i = 0; i < 120; ++i) {
    push(motion, {0.005 * i, 0.0, 1.0}, kUpright, 3.0 + 1.0e-6 * i);
  }
  const BodyState state = at(motion, 3.01);
  EXPECT_NEAR(state.position[0], 0.595, 1.0e-3);
  EXPECT_LT(length(state.velocity), 0.1);
}

// Two programs move the body, with time tags of the same clock.
TEST(LiveMotion, PosesThatDifferWithinAnInstantMakeNoSpeedThatABodyCannotHave) {
  const LiveLimits limits;
  LiveMotion motion(kRest, limits);
  double fastest = 0.0;  // [m/s]
  for (int i = 0; i < 50; ++i) {
    const double now = 1.0 + 0.010 * i;
    motion.push({0.0, 0.0, 1.0}, kUpright, {now, now, 1});
    motion.push({0.0, 0.19, 1.0}, from_turn({0.0, 0.0, 0.9}), {now, now + 1.0e-4, 1});
    const BodyState state = at(motion, now);
    fastest = std::max(fastest, length(state.velocity));
    EXPECT_LE(length(state.spin), limits.spin + 0.001) << i;
  }
  EXPECT_LE(fastest, 1.5 * limits.speed) << "with the change of place that fades out";
  EXPECT_GT(fastest, 1.0);
}

TEST(LiveMotion, MayBeReadWhileItIsWritten) {
  LiveMotion motion(kRest);
  std::thread writer([&] {
    for (int i = 0; i < 5000; ++i) {
      push(motion, {0.0, 0.0, 1.0 + 1e-4 * (i % 2)}, kUpright, i * 0.001);
    }
  });
  for (int i = 0; i < 5000; ++i) {
    EXPECT_TRUE(std::isfinite(at(motion, i * 0.001).position[2]));
  }
  writer.join();
}

// The second one's clock is so little behind that its tags could be the first one's, held up.
TEST(LiveMotion, TagsOfTwoSendersAreOfTwoClocks) {
  LiveMotion motion(kRest);
  for (double t = 0.0; t < 1.0; t += 0.01) {
    EXPECT_EQ(motion.push(swing(t), kUpright, {t, t, 1}), PoseRefusal::none);
    at(motion, t);
  }
  for (double t = 1.0; t < 1.5; t += 0.01) {
    EXPECT_EQ(motion.push(swing(t), kUpright, {t, t - 0.9, 2}), PoseRefusal::none) << t;
    EXPECT_NEAR(at(motion, t).position[0], swing(t)[0], 0.004) << t;
  }
}

}  // namespace
}  // namespace splash::sim
