// SPDX-License-Identifier: MIT
// What a frame may leave undone, and when it may not.
#include "sim-server/simulation/frame_plan.hpp"

#include <gtest/gtest.h>

#include <cmath>

namespace splash::sim {
namespace {

constexpr int kParticles = 100;
constexpr double kBubbleSpeed = 1.0;
constexpr double kFrame = 0.00625;

/// Water in the unit cube.
FluidStats water(double speed, int asleep) {
  FluidStats stats;
  stats.speed = speed;
  stats.asleep = asleep;
  stats.lower = {0.0, 0.0, 0.0};
  stats.upper = {1.0, 1.0, 1.0};
  return stats;
}

BodyStep body(float height, float speed) {
  BodyStep b = {};
  b.lower_x = b.lower_y = 0.4F;
  b.upper_x = b.upper_y = 0.6F;
  b.lower_z = height;
  b.upper_z = height + 0.2F;
  b.vz = -speed;
  b.speed = fastest_point(b);
  return b;
}

/// The second frame and on; the first knows nothing.
FramePlanner ready(const SkipSettings& skip = {}) {
  FramePlanner planner(skip, kBubbleSpeed, kParticles);
  const FramePlan first = planner.plan({}, water(0.0, kParticles), kFrame, false, 0);
  EXPECT_TRUE(first.steps && first.contacts && first.bubbles);
  return planner;
}

FramePlan look(FramePlanner& planner, const std::vector<BodyStep>& bodies, const FluidStats& last,
               bool piston = false, std::size_t bubbles = 0) {
  return planner.plan(bodies, last, kFrame, piston, bubbles);
}

TEST(FramePlanner, NothingWhileAllSleeps) {
  FramePlanner planner = ready();
  EXPECT_FALSE(look(planner, {}, water(0.01, kParticles)).steps);
  EXPECT_TRUE(look(planner, {}, water(0.01, kParticles - 1)).steps);
  EXPECT_TRUE(look(planner, {}, water(0.01, kParticles), true).steps) << "the wave maker moves";
  EXPECT_TRUE(look(planner, {}, water(0.01, kParticles), false, 1).steps) << "a bubble lives";
}

TEST(FramePlanner, ABodyCountsWhenItMovesNearTheWater) {
  FramePlanner planner = ready();
  const FluidStats asleep = water(0.0, kParticles);
  EXPECT_FALSE(look(planner, {body(0.9F, 0.0F)}, asleep).steps) << "it stands in the water";
  EXPECT_TRUE(look(planner, {body(0.9F, 0.01F)}, asleep).steps);
  EXPECT_FALSE(look(planner, {body(1.1F, 5.0F)}, asleep).steps) << "far above";
  BodyStep turning = body(0.9F, 0.0F);
  turning.wy = 0.1F;
  turning.speed = fastest_point(turning);
  EXPECT_TRUE(look(planner, {turning}, asleep).steps);
}

TEST(FramePlanner, ContactsWhereABodyIsNear) {
  FramePlanner planner = ready();
  EXPECT_FALSE(look(planner, {body(1.1F, 1.0F)}, water(0.5, 0)).contacts);
  EXPECT_TRUE(look(planner, {body(0.99F, 0.0F)}, water(0.5, 0)).contacts);
  EXPECT_TRUE(look(planner, {body(1.1F, 1.0F)}, water(20.0, 0)).contacts) << "a splash rises to it";
}

TEST(FramePlanner, BubblesOneFrameLongerThanWaterIsFast) {
  FramePlanner planner = ready();
  EXPECT_TRUE(look(planner, {}, water(0.9, 0)).bubbles);
  EXPECT_TRUE(look(planner, {}, water(0.1, 0)).bubbles) << "memories have to calm down";
  EXPECT_FALSE(look(planner, {}, water(0.1, 0)).bubbles);
  EXPECT_TRUE(look(planner, {}, water(0.1, 0), false, 3).bubbles) << "bubbles live";
  EXPECT_TRUE(look(planner, {}, water(0.1, 0)).bubbles);
  EXPECT_FALSE(look(planner, {}, water(0.1, 0)).bubbles);
  EXPECT_TRUE(look(planner, {body(0.9F, 2.0F)}, water(0.1, 0)).bubbles) << "a body is fast";
}

TEST(FramePlanner, EverythingWithTheSwitchesOff) {
  SkipSettings off;
  off.idle = off.contacts = off.bubbles = false;
  FramePlanner planner = ready(off);
  for (int k = 0; k < 3; ++k) {
    const FramePlan all = look(planner, {body(5.0F, 0.0F)}, water(0.0, kParticles));
    EXPECT_TRUE(all.steps && all.contacts && all.bubbles);
  }
}

// Where cells do not sleep by themselves: after three frames of rest, until something is at it.
TEST(FramePlanner, AllWaterSleepsAsAWhole) {
  FramePlanner planner({}, kBubbleSpeed, kParticles, {.speed = 0.003, .after = 2.5 * kFrame});
  const FluidStats slow = water(0.0029, 0), fast = water(0.0031, 0);
  const auto frames_to_sleep = [&] {
    int frames = 1;
    while (look(planner, {}, slow).steps && frames < 100) ++frames;
    return frames;
  };
  static_cast<void>(look(planner, {}, slow));  // knows nothing
  EXPECT_EQ(frames_to_sleep(), 4);
  EXPECT_FALSE(look(planner, {body(1.1F, 5.0F)}, slow).steps) << "far above";
  EXPECT_FALSE(look(planner, {body(0.9F, 0.0F)}, slow).steps) << "it stands in the water";
  BodyStep appeared = body(1.1F, 0.0F);
  appeared.grows = 1.0F;
  EXPECT_TRUE(look(planner, {appeared}, slow).steps) << "it left a hole";
  EXPECT_EQ(frames_to_sleep(), 4);
  EXPECT_TRUE(look(planner, {body(0.9F, 0.01F)}, slow).steps);
  EXPECT_EQ(frames_to_sleep(), 4);
  EXPECT_TRUE(look(planner, {}, slow, true).steps) << "the wave maker moves";
  EXPECT_EQ(frames_to_sleep(), 4);
  EXPECT_TRUE(look(planner, {}, slow, false, 1).steps) << "a bubble lives";
  EXPECT_EQ(frames_to_sleep(), 4);
  EXPECT_TRUE(look(planner, {}, fast).steps);
  EXPECT_EQ(frames_to_sleep(), 4);
  EXPECT_TRUE(look(planner, {}, water(std::nan(""), 0)).steps);
  planner.forget();
  EXPECT_TRUE(look(planner, {}, slow).steps);
  EXPECT_EQ(frames_to_sleep(), 4);
}

TEST(FramePlanner, EverythingAfterAFailure) {
  FramePlanner planner = ready();
  EXPECT_FALSE(look(planner, {}, water(0.0, kParticles)).steps);
  planner.forget();
  const FramePlan all = look(planner, {}, water(0.0, kParticles));
  EXPECT_TRUE(all.steps && all.contacts && all.bubbles);
}

}  // namespace
}  // namespace splash::sim
