// SPDX-License-Identifier: MIT
// A tracker of the test's own moves a body over UDP while the simulation runs.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <iostream>
#include <nlohmann/json.hpp>

#include "protocol/event_log.hpp"
#include "protocol/time_tag.hpp"
#include "tests/support/programs.hpp"
#include "tests/support/small_scene.hpp"
#include "tests/support/temporary_folder.hpp"
#include "tests/support/text_of.hpp"
#include "tests/support/waiting.hpp"

namespace splash::tests {
namespace {

constexpr double kPeriod = 0.01;  ///< of the tracker [s]
constexpr double kStart = 0.5;    ///< the disc rests before, then falls [s]
constexpr double kSpeed = 0.8;    ///< [m/s]
constexpr double kDepth = 0.12;   ///< its centre's height at the end [m]
constexpr double kSeconds = 1.2;

double height(double seconds) {
  const double fallen = kSpeed * std::max(0.0, seconds - kStart);
  return std::max(kDepth, SmallScene::kRest - fallen);
}

/// 100 poses a second, each with the time at which it was taken: whenever a busy machine sends it,
/// it says where the body was then.
void drive(Simulator& simulator) {
  const double start = protocol::unix_now();
  for (double seconds = 0.0; seconds < kSeconds; seconds += kPeriod) {
    const double left = start + seconds - protocol::unix_now();
    if (left > 0.0) sleep(left);
    simulator.send(protocol::encode(
        protocol::to_time_tag(start + seconds),
        {protocol::to_message(protocol::BodyPose{
            0, {0.0F, 0.0F, static_cast<float>(height(seconds))}, 0.0F, 0.0F, 0.0F, 1.0F})}));
  }
}

/// What a simulator of the scene tells while the disc falls.
std::vector<protocol::Impact> impacts_of(const SmallScene& scene, bool grabs) {
  const TemporaryFolder folder;
  const std::string log = folder / "tracker.osc";
  Simulator simulator({"--scene", scene.path(), "--record", log});
  if (grabs) {
    EXPECT_EQ(simulator.ask({"/body/grab", {7, 1}}, "/fail").arguments.size(), 2U)
        << "no such body";
    EXPECT_FALSE(simulator.ask({"/body/grab", {0, 1}}, "/done").arguments.empty());
  }
  drive(simulator);
  EXPECT_EQ(simulator.end(), 0) << simulator.process().output();
  std::vector<protocol::Impact> impacts;
  for (const auto& entry : protocol::read_log(log)) {
    for (const auto& message : entry.messages) {
      const auto event = protocol::to_event(message);
      if (!event) continue;
      if (const auto* impact = std::get_if<protocol::Impact>(&*event)) impacts.push_back(*impact);
    }
  }
  EXPECT_EQ(impacts.size(), 1U) << simulator.process().output();
  return impacts;
}

TEST(Tracker, OnePlungeIsOneImpact) {
  const auto impacts = impacts_of(SmallScene(tracked()), false);
  ASSERT_EQ(impacts.size(), 1U);
  EXPECT_EQ(impacts[0].body, 0);
  EXPECT_NEAR(static_cast<double>(impacts[0].speed), kSpeed, 0.1 * kSpeed);
  EXPECT_NEAR(static_cast<double>(impacts[0].position.z), SmallScene::kLevel, 0.04);
  EXPECT_LT(std::hypot(impacts[0].position.x, impacts[0].position.y), 0.08F);
  std::cout << "speed " << impacts[0].speed << " m/s at " << impacts[0].position.z << " m\n";
}

// Of a body that stays where it is: what moves it is the hand alone.
TEST(Tracker, AGrabbedBodyPlungesOnce) {
  const auto impacts =
      impacts_of(SmallScene("{kind: fixed}\n    rest: {position: [0, 0, 0.35]}"), true);
  ASSERT_EQ(impacts.size(), 1U);
  EXPECT_NEAR(static_cast<double>(impacts[0].speed), kSpeed, 0.1 * kSpeed);
}

TEST(Tracker, WithoutPosesNothingMoves) {
  const SmallScene scene(tracked());
  const auto [code, text] = simulate(scene.path(), 2.0);
  EXPECT_EQ(code, 0) << text;
  EXPECT_THAT(text, testing::HasSubstr("0 impacts, 0 bubbles, 0 cavities"));
}

// A tracker that takes two markers for one body, 3 m apart.
TEST(Tracker, PosesThatNoBodyCanFollowAreRefusedAndTold) {
  const SmallScene scene(tracked());
  const TemporaryFolder folder;
  const std::string report = folder / "refused.json";
  Simulator simulator({"--scene", scene.path(), "--report", report});
  ASSERT_FALSE(simulator.ask({"/notify", {1}}, "/done").arguments.empty());
  for (int k = 0; k < 20; ++k) {
    const float x = k % 2 == 0 ? 1.5F : -1.5F;
    simulator.send(protocol::encode(
        protocol::to_message(protocol::BodyPose{0, {x, 0.0F, 0.35F}, 0.0F, 0.0F, 0.0F, 1.0F})));
  }
  EXPECT_TRUE(simulator.process().wait_for_text(
      "a pose of body 'disc' was refused: the speed is beyond the limit"));
  const protocol::Message told = simulator.ask({"/version", {}}, "/fail");  // as a page is told
  ASSERT_EQ(told.arguments.size(), 2U);
  EXPECT_EQ(std::get<std::string>(told.arguments[0]), "/body/pose");
  EXPECT_EQ(std::get<std::string>(told.arguments[1]), "'disc': the speed is beyond the limit");
  ASSERT_EQ(simulator.end(), 0) << simulator.process().output();
  EXPECT_GE(nlohmann::json::parse(text_of(report)).at("refused_poses").get<int>(), 1);
}

// Millimetres, centimetres, and metres with y up.
TEST(Tracker, PlacesThatNoWaterIsAtAreToldWithWhatPosesMean) {
  const SmallScene scene(tracked());
  Simulator simulator({"--scene", scene.path()});
  const auto pose = [&](float x, float y, float z) {
    simulator.send(protocol::encode(
        protocol::to_message(protocol::BodyPose{0, {x, y, z}, 0.0F, 0.0F, 0.0F, 1.0F})));
  };
  const auto is_told = [&](const std::string& words) {
    return simulator.process().wait_for_text("poses put body 'disc' at " + words +
                                             ". Poses are in metres, x y z with z up");
  };
  const auto begin_anew = [&] {
    pose(0.0F, 0.0F, 0.35F);
    sleep(1.1);
  };
  ASSERT_FALSE(simulator.ask({"/notify", {1}}, "/done").arguments.empty());
  pose(100.0F, 0.0F, 350.0F);
  EXPECT_TRUE(is_told("100.00 0.00 350.00 m, 363.5 m outside of the tank"));
  begin_anew();
  pose(10.0F, 0.0F, 35.0F);
  EXPECT_TRUE(is_told("10.00 0.00 35.00 m, 35.9 m outside of the tank"));
  begin_anew();
  pose(0.1F, 0.35F, -0.4F);
  EXPECT_TRUE(is_told("0.10 0.35 -0.40 m, 0.40 m below the tank's floor"));
  const protocol::Message told = simulator.ask({"/version", {}}, "/fail");
  ASSERT_EQ(told.arguments.size(), 2U);
  EXPECT_EQ(std::get<std::string>(told.arguments[1]),
            "'disc' is 363.5 m outside of the tank: metres? z up?");
}

}  // namespace
}  // namespace splash::tests
