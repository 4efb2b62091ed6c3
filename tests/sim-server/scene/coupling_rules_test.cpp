// SPDX-License-Identifier: MIT
// A body on a spring is read with all that it needs, and a spring that could give a hand energy is
// refused: at the limit a simulated device, which feels it as late as a device does, comes to rest,
// and with less damping of its own it does not.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <deque>

#include "sim-server/scene/scene_reader.hpp"
#include "tests/support/refusal.hpp"

namespace splash::sim {
namespace {

using ::testing::AllOf;
using ::testing::HasSubstr;

std::string pool(const std::string& motion, const std::string& shape = "size: [0.1, 0.1, 0.1]") {
  return "fluid: {particles: 1000}\n"
         "tank: {lower: [0, 0, 0], upper: [1, 1, 1]}\n"
         "water: [{lower: [0, 0, 0], upper: [1, 1, 0.5]}]\n"
         "bodies:\n"
         "  - name: hand\n"
         "    shape: {" +
         shape +
         "}\n"
         "    rest: {position: [0.5, 0.5, 0.8]}\n"
         "    motion: {kind: osc, " +
         motion + "}\n";
}

std::string refusal(const std::string& motion, const std::string& shape = "size: [0.1, 0.1, 0.1]") {
  return tests::refusal([&] { return parse_scene(pool(motion, shape), "pool.yaml"); });
}

TEST(CouplingRules, ABodyOnASpringIsFreeAndTied) {
  const Scene scene = parse_scene(
      pool(
          "coupling: spring, mass: 0.3, stiffness: 80, damping: 1, device_damping: 5, friction: 0"),
      "pool.yaml");
  const BodySettings& hand = scene.bodies.at(0);
  EXPECT_TRUE(is_tied(hand));
  EXPECT_TRUE(is_free(hand));
  EXPECT_EQ(hand.motion.stiffness, 80.0);
  EXPECT_EQ(hand.motion.damping, 1.0);
  const Scene direct = parse_scene(pool("coupling: direct"), "pool.yaml");
  EXPECT_FALSE(is_tied(direct.bodies.at(0)));
  EXPECT_FALSE(is_free(direct.bodies.at(0)));
}

TEST(CouplingRules, WhatASpringLacksOrCannotHaveIsTold) {
  EXPECT_THAT(refusal("coupling: spring, mass: 0.3, device_damping: 5"),
              AllOf(HasSubstr("pool.yaml:8:"), HasSubstr("a spring needs 'stiffness'")));
  EXPECT_THAT(refusal("coupling: spring, mass: 0.3, stiffness: 50"),
              HasSubstr("a spring needs 'device_damping'"));
  EXPECT_THAT(refusal("coupling: spring, stiffness: 50, device_damping: 5"),
              HasSubstr("a body on a spring needs one of 'density' and 'mass'"));
  EXPECT_THAT(refusal("stiffness: 50"),
              HasSubstr("has no meaning for a motion of kind osc without coupling: spring"));
  EXPECT_THAT(refusal("mass: 0.3"), HasSubstr("without coupling: spring"));
  const std::string whole = "coupling: spring, mass: 0.3, stiffness: 50, device_damping: 5";
  EXPECT_EQ(refusal(whole), "");
  EXPECT_THAT(refusal(whole + ", gap: hold"), HasSubstr("motion.gap"));
  EXPECT_THAT(refusal(whole + ", velocity: [1, 0, 0]"), HasSubstr("has no meaning"));
  EXPECT_THAT(refusal(whole, "size: [0.1, 0.1, 0.1], rocker: 0.01"), HasSubstr("curved sole"));
  EXPECT_THAT(refusal("coupling: sprung"), HasSubstr("spring"));
}

TEST(CouplingRules, ASpringThatIsFeltTooLateIsRefused) {
  // 200 N/m x (1.5 / 160 + 0.03) s + 1 = 8.875 N s/m.
  const std::string motion =
      "coupling: spring, mass: 0.3, damping: 1, device_damping: 2, stiffness: ";
  const std::string said = refusal(motion + "200");
  EXPECT_THAT(said,
              AllOf(HasSubstr("pool.yaml:8:"), HasSubstr("motion.stiffness"), HasSubstr("200 N/m"),
                    HasSubstr("39.375 ms"), HasSubstr("8.875 N s/m"),
                    HasSubstr("device_damping is 2"), HasSubstr("25.39"), HasSubstr("delay_limit")))
      << said;
  EXPECT_EQ(refusal(motion + "25.39"), "");
  EXPECT_NE(refusal(motion + "25.40"), "");
  EXPECT_EQ(refusal(motion + "100, delay_limit: 0"), "") << "100 x 9.375 ms + 1";
}

/// How many times as far a device of `mass` swings in the end as at first, on a spring to a wall:
/// its place is read once a frame, the force for it comes `late` after that, and holds for a frame.
double swing(double mass, double damping, double stiffness, double frame, double late) {
  constexpr double kDt = 1.0e-5;
  std::deque<std::pair<double, double>> under_way;
  double x = 0.01, v = 0.0, force = 0.0, next = 0.0, most = 0.0;
  const double period = 2.0 * M_PI * std::sqrt(mass / stiffness);
  const double end = 20.0 * period;
  for (double now = 0.0; now < end; now += kDt) {
    if (now >= next) {
      under_way.emplace_back(now + late, -stiffness * x);
      next += frame;
    }
    while (!under_way.empty() && under_way.front().first <= now) {
      force = under_way.front().second;
      under_way.pop_front();
    }
    v += kDt / mass * (force - damping * v);
    x += kDt * v;
    if (now > end - period) most = std::max(most, std::abs(x));
  }
  return most / 0.01;
}

TEST(CouplingRules, AtTheLimitADeviceComesToRestAndWithLessDampingItDoesNot) {
  constexpr double kFrame = 1.0 / 160.0, kDelay = 0.03, kDamping = 4.0;
  double low = 1.0, high = 1000.0;
  for (int k = 0; k < 30; ++k) {
    const double middle = (low + high) / 2.0;
    const std::string said = refusal("coupling: spring, mass: 0.3, device_damping: 4, stiffness: " +
                                     std::to_string(middle));
    (said.empty() ? low : high) = middle;
  }
  for (const double mass : {0.1, 0.3, 1.0, 5.0}) {
    EXPECT_LT(swing(mass, kDamping, low, kFrame, kFrame + kDelay), 1.0) << mass;
  }
  // Slow swings are where a late spring is most like a damper that gives.
  EXPECT_GT(swing(5.0, 0.8 * kDamping, low, kFrame, kFrame + kDelay), 1.0);
}

}  // namespace
}  // namespace splash::sim
