// SPDX-License-Identifier: MIT
// A hand feels the water of the real simulator through examples/force, and nothing soon after that
// was killed.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <chrono>
#include <cmath>
#include <csignal>
#include <iostream>
#include <nlohmann/json.hpp>
#include <thread>

#include "examples/force/splash_force.hpp"
#include "protocol/time_tag.hpp"
#include "tests/support/programs.hpp"
#include "tests/support/small_scene.hpp"
#include "tests/support/temporary_folder.hpp"
#include "tests/support/text_of.hpp"
#include "tests/support/waiting.hpp"

namespace splash::tests {
namespace {

constexpr double kSilence = 0.05;  ///< nothing is left of a force after it [s]

/// A loop at 1 kHz that holds the disc's middle at the water's surface, and what it feels.
class Hand {
 public:
  explicit Hand(std::uint16_t port) : water_("127.0.0.1", port, 0) {}

  /// Turns for `seconds`; the force at the end [N].
  double turn(double seconds) {
    const double end = protocol::monotonic_now() + seconds;
    while (protocol::monotonic_now() < end) {
      const splash_force::Vector place = {0.0, 0.0, SmallScene::kLevel};
      water_.send_pose(place, {0.0, 0.0, 0.0, 1.0});
      const double now = protocol::monotonic_now();
      const double silent = water_.silence();
      const double force = water_.force(place, {}, {}).force[2];
      // By the device's own clock, whatever else the machine does, and if no word came between.
      if (silent >= kSilence && water_.silence() >= silent && force != 0.0) ++too_long_;
      // By the slew limit of 200 N/s, or nothing at all after a silence.
      const double most = 200.0 * (now - last_ + 2.0e-3);
      if (last_ > 0.0 && force != 0.0)
        steepest_ = std::max(steepest_, std::abs(force - force_) / most);
      last_ = now;
      force_ = force;
      std::this_thread::sleep_for(std::chrono::milliseconds(1));
    }
    return force_;
  }
  [[nodiscard]] double steepest() const { return steepest_; }
  [[nodiscard]] double silence() { return water_.silence(); }
  /// Forces that were left after the silence that ends them.
  [[nodiscard]] int too_long() const { return too_long_; }

 private:
  splash_force::Client water_;
  double last_ = 0.0;
  double force_ = 0.0;
  double steepest_ = 0.0;
  int too_long_ = 0;
};

TEST(Force, IsFeltAndGoneWhenTheSimulatorIsKilled) {
  const SmallScene scene(tracked());
  Simulator simulator({"--scene", scene.path()});
  ASSERT_TRUE(simulator.process().wait_for_text("running")) << simulator.process().output();
  Hand hand(simulator.endpoint().port);
  double felt = 0.0;
  for (int k = 0; k < 300 && felt < 1.0; ++k) felt = hand.turn(0.1);
  ASSERT_GE(felt, 1.0) << "the disc's buoyancy is 4 N";
  EXPECT_LE(hand.steepest(), 1.0) << "it grew in a ramp";
  hand.turn(0.5);
  simulator.process().signal(SIGKILL);
  const double killed = protocol::monotonic_now();
  double none = 0.0;  // after the kill, with what lay in the socket
  while (hand.silence() < 2.0 * kSilence) {
    if (hand.turn(0.001) != 0.0) none = protocol::monotonic_now() - killed;
  }
  std::cout << "felt " << felt << " N, none " << 1e3 * none << " ms after the kill\n";
  EXPECT_EQ(hand.turn(0.001), 0.0);
  EXPECT_EQ(hand.too_long(), 0) << "50 ms after the last word there is none";
  EXPECT_LE(hand.steepest(), 1.0) << "it went in a ramp";
}

TEST(Force, IsFoundOnlyWhileSomebodyAsks) {
  const SmallScene scene(tracked());
  const TemporaryFolder folder;
  const std::string report = folder / "felt.json";
  const auto felt_frames = [&](bool asks) {
    Simulator simulator({"--scene", scene.path(), "--report", report});
    EXPECT_TRUE(simulator.process().wait_for_text("running")) << simulator.process().output();
    if (asks) {
      EXPECT_FALSE(simulator.ask({"/notify", {2}}, "/done").arguments.empty());
      EXPECT_FALSE(simulator.ask({"/version", {}}, "/force").arguments.empty()) << "streamed";
    }
    sleep(0.2);
    EXPECT_EQ(simulator.end(), 0) << simulator.process().output();
    return nlohmann::json::parse(text_of(report)).at("felt_frames").get<int>();
  };
  EXPECT_EQ(felt_frames(false), 0);
  EXPECT_GT(felt_frames(true), 0);
}

TEST(Force, IsToldOfABodyWhileItIsGrabbed) {
  const SmallScene scene(plunging());
  Simulator simulator({"--scene", scene.path()});
  ASSERT_TRUE(simulator.process().wait_for_text("running")) << simulator.process().output();
  ASSERT_FALSE(simulator.ask({"/notify", {2}}, "/done").arguments.empty());
  ASSERT_FALSE(simulator.ask({"/body/grab", {0, 1}}, "/done").arguments.empty());
  const protocol::Message pose = {
      "/body/pose",
      {0, 0.0F, 0.0F, static_cast<float>(SmallScene::kLevel), 0.0F, 0.0F, 0.0F, 1.0F}};
  bool felt = false;
  for (int k = 0; k < 500 && !felt; ++k) {
    const protocol::Message force = simulator.ask(pose, "/force");
    felt = force.arguments.size() == 7U && std::get<float>(force.arguments[3]) > 1.0F;
  }
  EXPECT_TRUE(felt) << "the disc's buoyancy is 4 N";
}

TEST(Force, IsRefusedWherePosesMoveNoBody) {
  const SmallScene scene("{kind: free, density: 500}\n    rest: {position: [0, 0, 0.35]}");
  Simulator simulator({"--scene", scene.path()});
  const protocol::Message reply = simulator.ask({"/notify", {2}}, "/fail");
  ASSERT_EQ(reply.arguments.size(), 2U);
  EXPECT_THAT(std::get<std::string>(reply.arguments[1]), testing::HasSubstr("poses move no body"));
}

}  // namespace
}  // namespace splash::tests
