// SPDX-License-Identifier: MIT
// What a frame may leave undone, and when it may not.
#include "sim-server/simulation/needs.hpp"

#include <gtest/gtest.h>

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
Needs ready(const SkipSettings& skip = {}) {
  Needs needs(skip, kBubbleSpeed, kParticles);
  const FrameNeeds first = needs.of_frame({}, water(0.0, kParticles), kFrame, false, 0);
  EXPECT_TRUE(first.steps && first.contacts && first.bubbles);
  return needs;
}

FrameNeeds look(Needs& needs, const std::vector<BodyStep>& bodies, const FluidStats& last,
                bool piston = false, std::size_t bubbles = 0) {
  return needs.of_frame(bodies, last, kFrame, piston, bubbles);
}

TEST(Needs, NothingWhileAllSleeps) {
  Needs needs = ready();
  EXPECT_FALSE(look(needs, {}, water(0.01, kParticles)).steps);
  EXPECT_TRUE(look(needs, {}, water(0.01, kParticles - 1)).steps);
  EXPECT_TRUE(look(needs, {}, water(0.01, kParticles), true).steps) << "the wave maker moves";
  EXPECT_TRUE(look(needs, {}, water(0.01, kParticles), false, 1).steps) << "a bubble lives";
}

TEST(Needs, ABodyCountsWhenItMovesNearTheWater) {
  Needs needs = ready();
  const FluidStats asleep = water(0.0, kParticles);
  EXPECT_FALSE(look(needs, {body(0.9F, 0.0F)}, asleep).steps) << "it stands in the water";
  EXPECT_TRUE(look(needs, {body(0.9F, 0.01F)}, asleep).steps);
  EXPECT_FALSE(look(needs, {body(1.1F, 5.0F)}, asleep).steps) << "far above";
  BodyStep turning = body(0.9F, 0.0F);
  turning.wy = 0.1F;
  turning.speed = fastest_point(turning);
  EXPECT_TRUE(look(needs, {turning}, asleep).steps);
}

TEST(Needs, ContactsWhereABodyIsNear) {
  Needs needs = ready();
  EXPECT_FALSE(look(needs, {body(1.1F, 1.0F)}, water(0.5, 0)).contacts);
  EXPECT_TRUE(look(needs, {body(0.99F, 0.0F)}, water(0.5, 0)).contacts);
  EXPECT_TRUE(look(needs, {body(1.1F, 1.0F)}, water(20.0, 0)).contacts) << "a splash rises to it";
}

TEST(Needs, BubblesOneFrameLongerThanWaterIsFast) {
  Needs needs = ready();
  EXPECT_TRUE(look(needs, {}, water(0.9, 0)).bubbles);
  EXPECT_TRUE(look(needs, {}, water(0.1, 0)).bubbles) << "memories have to calm down";
  EXPECT_FALSE(look(needs, {}, water(0.1, 0)).bubbles);
  EXPECT_TRUE(look(needs, {}, water(0.1, 0), false, 3).bubbles) << "bubbles live";
  EXPECT_TRUE(look(needs, {}, water(0.1, 0)).bubbles);
  EXPECT_FALSE(look(needs, {}, water(0.1, 0)).bubbles);
  EXPECT_TRUE(look(needs, {body(0.9F, 2.0F)}, water(0.1, 0)).bubbles) << "a body is fast";
}

TEST(Needs, EverythingWithTheSwitchesOff) {
  SkipSettings off;
  off.idle = off.contacts = off.bubbles = false;
  Needs needs = ready(off);
  for (int k = 0; k < 3; ++k) {
    const FrameNeeds all = look(needs, {body(5.0F, 0.0F)}, water(0.0, kParticles));
    EXPECT_TRUE(all.steps && all.contacts && all.bubbles);
  }
}

TEST(Needs, EverythingAfterAFailure) {
  Needs needs = ready();
  EXPECT_FALSE(look(needs, {}, water(0.0, kParticles)).steps);
  needs.forget();
  const FrameNeeds all = look(needs, {}, water(0.0, kParticles));
  EXPECT_TRUE(all.steps && all.contacts && all.bubbles);
}

}  // namespace
}  // namespace splash::sim
