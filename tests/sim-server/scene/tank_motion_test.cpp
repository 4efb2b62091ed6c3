// SPDX-License-Identifier: MIT
// What a tank that moves does to what is in it: as formulas say, whoever asks when; and what scenes
// say of it.
#include "sim-server/scene/tank_motion.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "sim-server/scene/resolution.hpp"
#include "sim-server/scene/rotation.hpp"
#include "sim-server/scene/scene_reader.hpp"
#include "tests/support/refusal.hpp"

namespace splash::sim {
namespace {

using ::testing::HasSubstr;

const Vector3 kGravity = {0.0, 0.0, -9.81};

TankMotionSettings rolling() {
  return {.present = true, .roll = {0.0, 30.0, 0.0}, .period = 2.0, .samples = {}};
}

TEST(TankMotion, TurnsGravityWithTheTank) {
  TankMotion tank(rolling(), kGravity);
  for (const double t : {0.1, 0.5, 0.7364, 1.3, 7.9}) {
    const double angle = std::numbers::pi / 6.0 * std::sin(std::numbers::pi * t);
    const TankState state = tank.at(t);
    EXPECT_NEAR(state.gravity[0], 9.81 * std::sin(angle), 1.0e-4) << t;
    EXPECT_NEAR(state.gravity[2], -9.81 * std::cos(angle), 1.0e-4) << t;
    EXPECT_NEAR(state.gravity[1], 0.0, 1.0e-12);
    EXPECT_NEAR(state.spin[1], std::pow(std::numbers::pi, 2) / 6.0 * std::cos(std::numbers::pi * t),
                1.0e-12);
    const double h = 1.0e-5;
    EXPECT_NEAR(state.spin_rate[1], (tank.at(t + h).spin[1] - tank.at(t - h).spin[1]) / (2.0 * h),
                1.0e-6);
  }
}

TEST(TankMotion, IsTheSameWhoeverAskedBefore) {
  TankMotion steady(rolling(), kGravity);
  TankMotion jumping(rolling(), kGravity);
  for (double t = 0.0; t < 3.0; t += 0.0067) static_cast<void>(steady.at(t));
  static_cast<void>(jumping.at(9.0));
  EXPECT_EQ(steady.at(3.33).gravity, jumping.at(3.33).gravity);
}

TEST(TankMotion, GrowsSmoothlyFromNothing) {
  const TankMotionSettings motion = {
      .present = true, .sway = {0.05, 0.0, 0.0}, .period = 0.9, .ramp = 1.5, .samples = {}};
  TankMotion tank(motion, kGravity);
  EXPECT_NEAR(tank.at(0.0).gravity[0], 0.0, 1.0e-12);
  // What it feels is minus the second derivative of where it is.
  const auto place = [&](double t) {
    const double s = std::min(t / motion.ramp, 1.0);
    const double share = s * s * s * (10.0 - 15.0 * s + 6.0 * s * s);
    return share * 0.05 * std::sin(2.0 * std::numbers::pi * t / motion.period);
  };
  const double h = 1.0e-4;
  for (const double t : {0.2, 0.77, 1.4, 1.6, 3.0}) {
    const double bend = (place(t + h) - 2.0 * place(t) + place(t - h)) / (h * h);
    EXPECT_NEAR(tank.at(t).gravity[0], -bend, 1.0e-4) << t;
    EXPECT_LE(std::abs(bend), bounds_of(motion).acceleration);
  }
}

TEST(TankMotion, GoesAlongStraightLinesBetweenSamples) {
  const TankMotionSettings motion = {.present = true,
                                     .samples = {{1.0, {0.0, 0.0, 0.0}, {0.0, 0.0, 0.0}},
                                                 {3.0, {2.0, 0.0, 1.0}, {0.0, 0.0, 4.0}}}};
  TankMotion tank(motion, kGravity);
  EXPECT_EQ(tank.at(0.5).gravity, kGravity);
  const TankState half = tank.at(2.0);
  EXPECT_NEAR(length(half.gravity - Vector3{-1.0, 0.0, -10.31}), 0.0, 1.0e-9);
  EXPECT_NEAR(half.spin[2], 2.0, 1.0e-12);
  EXPECT_NEAR(half.spin_rate[2], 2.0, 1.0e-12);
  const TankState after = tank.at(5.0);
  EXPECT_NEAR(after.spin[2], 4.0, 1.0e-12);
  EXPECT_EQ(after.spin_rate[2], 0.0);
  EXPECT_DOUBLE_EQ(bounds_of(motion).spin_rate, 2.0);
}

std::string tank(const std::string& motion, const std::string& more = "") {
  return "fluid: {particles: 1000}\n"
         "tank: {lower: [0, 0, 0], upper: [1, 1, 1]}\n"
         "water: [{lower: [0, 0, 0], upper: [1, 1, 0.5]}]\n"
         "tank_motion: {" +
         motion + "}\n" + more;
}

std::string refusal(const std::string& motion, const std::string& more = "") {
  return tests::refusal([&] { return parse_scene(tank(motion, more), "tank.yaml"); });
}

TEST(TankMotion, IsReadFromAScene) {
  const Scene scene = parse_scene(
      tank("pivot: [0.5, 0.5, 0], roll: [0, 4, 0], period: 1.9, ramp: 2,\n"
           "  samples: [{time: 0}, {time: 2, acceleration: [1, 0, 0], spin: [0, 0, 1]}]"),
      "tank.yaml");
  EXPECT_TRUE(scene.tank_motion.present);
  EXPECT_TRUE(turns(scene.tank_motion));
  EXPECT_EQ(scene.tank_motion.samples.at(1).spin[2], 1.0);
  // Sound is as much faster as the tank's motion is violent.
  const Scene still = parse_scene(tank("sway: [0.001, 0, 0], period: 10"), "tank.yaml");
  EXPECT_GT(longest_wave(scene), 1.05 * longest_wave(still));
  EXPECT_FALSE(turns(still.tank_motion));
}

TEST(TankMotion, MistakesAreTold) {
  EXPECT_THAT(refusal("pivot: [0, 0, 0]"), HasSubstr("nothing moves the tank"));
  EXPECT_THAT(refusal("sway: [0.1, 0, 0]"), HasSubstr("tank.yaml:4:"));
  EXPECT_THAT(refusal("sway: [0.1, 0, 0]"), HasSubstr("sway and roll need it"));
  EXPECT_THAT(refusal("period: 2, samples: [{time: 0, spin: [0, 0, 1]}]"),
              HasSubstr("no meaning without 'sway' or 'roll'"));
  EXPECT_THAT(refusal("samples: [{time: 1}, {time: 1}]"), HasSubstr("not later"));
  EXPECT_THAT(refusal("roll: [0, 100, 0], period: 1"), HasSubstr("-90..90"));
  const std::string duck =
      "bodies: [{name: duck, shape: {size: [0.1, 0.1, 0.1]}, rest: {position: [0.5, 0.5, 0.7]},\n"
      "  motion: {kind: free, density: 500}}]\n";
  EXPECT_THAT(refusal("roll: [0, 5, 0], period: 1", duck), HasSubstr("the free body 'duck'"));
  EXPECT_EQ(refusal("sway: [0.05, 0, 0], period: 1", duck), "");
}

}  // namespace
}  // namespace splash::sim
