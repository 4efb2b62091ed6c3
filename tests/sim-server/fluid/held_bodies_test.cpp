// SPDX-License-Identifier: MIT
// Free bodies that are held by some axes, have an inertia of their own, or rub on something in a
// way of their own: against what mechanics says.
#include <gtest/gtest.h>

#include <cmath>

#include "sim-server/bodies/mass.hpp"
#include "sim-server/scene/rotation.hpp"
#include "tests/sim-server/fluid/free_float.hpp"

namespace splash::sim {
namespace {

const Shape kBall = {ShapeKind::sphere, {0.1, 0.1, 0.1}};
const Shape kBrick = {ShapeKind::box, {0.3, 0.2, 0.1}};

/// Bits of `held`.
constexpr int kAlongX = 1, kAlongY = 2, kAlongZ = 4, kAboutX = 8, kAboutY = 16, kAboutZ = 32;
constexpr int kTurns = kAboutX | kAboutY | kAboutZ;

MotionSettings& last_motion(FreeFloat& world) {
  return world.scene.bodies.back().motion;
}

TEST(HeldBodies, MoveAndTurnOnlyAsTheyMay) {
  Device device(-1, false, SPLASH_TEST_LANES);
  for (const auto solver : {PressureKind::weakly_compressible, PressureKind::grid_projected}) {
    FreeFloat world = drop_and_body(
        {ShapeKind::box, {0.1, 0.08, 0.06}}, 500.0,
        {{0.5, 0.49, 0.62}, from_turn({0.3, 0.2, 0.1}), {0.0, 0.0, -2.0}, {0.0, -5.0, 0.0}});
    world.scene.fluid.solver = solver;
    last_motion(world).held = kAlongX | kAboutX | kAboutZ;
    world.start(device);
    const Balance before = world.balance();
    world.run(0.1);
    const Balance after = world.balance();
    const BodyState s = world.state(0);
    EXPECT_EQ(s.position[0], static_cast<double>(0.5F));
    EXPECT_EQ(s.velocity[0], 0.0);
    EXPECT_EQ(s.spin[0], 0.0);
    EXPECT_EQ(s.spin[2], 0.0);
    EXPECT_GT(s.velocity[2], -1.9) << "the water slows it down";
    if (solver == PressureKind::grid_projected) continue;
    // Along the axes that are free nothing is lost between it and the water.
    const double rounding = 2.0e-5 * before.scale;
    EXPECT_GT(length(after.water - before.water), 10.0 * rounding);
    EXPECT_NEAR(after.all()[1], before.all()[1], rounding);
    EXPECT_NEAR(after.all()[2], before.all()[2], rounding);
    EXPECT_GT(std::abs(after.all()[0] - before.all()[0]), 10.0 * rounding)
        << "what holds it pushes";
  }
}

// A box that stands askew on its axle tumbles as soon as it is let go; held it turns on.
TEST(HeldBodies, TurnOnTheirAxle) {
  Device device(-1, false, SPLASH_TEST_LANES);
  for (const bool held : {true, false}) {
    FreeFloat world = dry_world(0.0);
    world.add(kBrick, 500.0,
              {{1.5, 1.5, 1.0}, from_turn({0.5, 0.7, 0.1}), {0.0, 0.0, 0.0}, {0.0, 0.0, 6.0}});
    last_motion(world).held = held ? kAboutX | kAboutY : 0;
    world.start(device);
    world.run(1.0);
    const double off = length(world.state(0).spin - Vector3{0.0, 0.0, 6.0});
    EXPECT_TRUE(held ? off < 2.0e-3 : off > 0.5) << off;
  }
}

TEST(HeldBodies, HangInTheAirAndAreHitThere) {
  Device device(-1, false, SPLASH_TEST_LANES);
  FreeFloat world = dry_world(-9.81);
  world.add(kBall, 1000.0, {{1.5, 1.5, 1.0}});
  last_motion(world).held = kAlongX | kAlongY | kAlongZ | kTurns;
  world.add(kBall, 1000.0, {{1.5, 1.5, 1.3}});
  for (BodySettings& body : world.scene.bodies) body.motion.restitution = 0.5;
  world.start(device);
  double low = 2.0, high = 0.0;
  while (world.time < 0.7) {
    world.run(world.dt);
    const double z = world.state(1).position[2];
    low = std::min(low, z);
    if (world.time > 0.25) high = std::max(high, z);
  }
  EXPECT_EQ(world.state(0).position[2], 1.0);
  EXPECT_GT(low, 1.1 - 1.0e-4) << "in the other";
  EXPECT_NEAR(high, 1.1 + 0.25 * 0.2, 0.01) << "half the speed, a quarter of the height";
}

/// Speed of what slides for so long on the floor from 2 m/s on [m/s].
double after_sliding(Device& device, double seconds, int held, double moment,
                     const std::vector<PairFriction>& pairs) {
  FreeFloat world = dry_world(-9.81);
  world.add(kBall, 1000.0, {{0.5, 1.5, 0.05}, {0, 0, 0, 1}, {2.0, 0.0, 0.0}});
  last_motion(world).held = held;
  last_motion(world).friction = 0.3;
  last_motion(world).inertia = {moment, moment, moment};
  world.scene.frictions = pairs;
  world.start(device);
  world.run(seconds);
  return world.state(0).velocity[0];
}

TEST(HeldBodies, SlideAsCoulombSays) {
  Device device(-1, false, SPLASH_TEST_LANES);
  EXPECT_NEAR(after_sliding(device, 0.3, kTurns, 0.0, {}), 2.0 - 0.3 * 9.81 * 0.3, 0.05);
  const double wet = after_sliding(device, 0.3, kTurns, 0.0, {{0, -1, 0.1}});
  EXPECT_NEAR(wet, 2.0 - 0.1 * 9.81 * 0.3, 0.03) << "of its own on walls";
}

// It slips until it rolls: v = v0 / (1 + I / (m r^2)).
TEST(OwnInertia, SaysHowSoonABallRolls) {
  Device device(-1, false, SPLASH_TEST_LANES);
  const double mass = 1000.0 * M_PI / 6.0 * 0.001;
  const double hoop = mass * 0.05 * 0.05;
  EXPECT_NEAR(after_sliding(device, 0.6, 0, 0.0, {}), 2.0 / 1.4, 0.02);
  EXPECT_NEAR(after_sliding(device, 0.6, 0, hoop, {}), 2.0 / 2.0, 0.02);
}

TEST(PairFriction, IsThatOfTheTwoThatTouch) {
  Device device(-1, false, SPLASH_TEST_LANES);
  // A brick slides over one that lies; both may only move along x.
  for (const double friction : {0.0, 0.2}) {
    FreeFloat world = dry_world(-9.81);
    world.add(kBrick, 1000.0, {{1.0, 1.5, 0.05}});
    last_motion(world).held = kAlongX | kAlongY | kTurns;
    world.add(kBrick, 1000.0, {{1.0, 1.5, 0.15}, {0, 0, 0, 1}, {0.5, 0.0, 0.0}});
    last_motion(world).held = kAlongY | kTurns;
    world.scene.frictions = {{1, 0, friction}};
    world.start(device);
    world.run(0.2);
    EXPECT_NEAR(world.state(1).velocity[0], 0.5 - friction * 9.81 * 0.2, 0.03) << friction;
  }
}

}  // namespace
}  // namespace splash::sim
