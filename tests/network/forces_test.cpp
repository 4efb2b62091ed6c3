// SPDX-License-Identifier: MIT
// The synth asks a simulator on another host, whose clock is an hour off, for the forces on its
// bodies: they are felt when the events of the same moment are.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <iostream>
#include <map>
#include <numbers>
#include <thread>

#include "protocol/event_log.hpp"
#include "protocol/time_tag.hpp"
#include "tests/network/two_hosts.hpp"
#include "tests/support/median.hpp"
#include "tests/support/small_scene.hpp"
#include "tests/support/temporary_folder.hpp"

namespace splash::network {
namespace {

using tests::Arguments;

/// A swing through the water's surface, four times a second.
protocol::BodyPose pose_at(double seconds) {
  protocol::BodyPose pose;
  const double swing = 0.04 * std::sin(2.0 * std::numbers::pi * 4.0 * seconds);
  pose.position.z = static_cast<float>(tests::SmallScene::kLevel + swing);
  return pose;
}

/// Of a log: when each bubble started, and when the body was pushed [s].
struct Moments {
  std::map<std::int32_t, double> bubbles;  ///< by id
  std::map<float, double> pushes;          ///< by the body's height, which is another each time
};
Moments moments_of(const std::string& path) {
  Moments moments;
  for (const protocol::LogEntry& entry : protocol::read_log(path)) {
    for (const protocol::Message& message : entry.messages) {
      if (message.address == "/body/at" || message.address == "/force/change") {
        moments.pushes[std::get<float>(message.arguments.at(3))] = entry.seconds;
      }
      const auto event = protocol::to_event(message);
      if (!event || !protocol::is_bubble(*event)) continue;
      const auto& bubble = std::get<protocol::Bubble>(*event);
      moments.bubbles[bubble.id] = entry.seconds + 1e-3 * static_cast<double>(bubble.offset_ms);
    }
  }
  return moments;
}

/// Median of how much later those of `played` are than those of `meant` [s].
template <class Key>
double later(const std::map<Key, double>& played, const std::map<Key, double>& meant) {
  std::vector<double> all;
  for (const auto& [key, moment] : played) {
    if (const auto found = meant.find(key); found != meant.end()) {
      all.push_back(moment - found->second);
    }
  }
  EXPECT_GT(all.size(), 10U);
  return tests::median(std::move(all));
}

TEST_F(OnTwoHosts, ForcesAreFeltWithTheEventsThoughTheClocksAreAnHourApart) {
  const tests::TemporaryFolder folder;
  const std::string sound = folder.write("texture.yaml", "name: texture\nfoot: {texture: 0.001}\n");
  const std::string told = folder / "told.osc";
  const std::string started = folder / "started.osc";
  const tests::SmallScene scene(tests::tracked());
  auto simulator = start(
      kSimHost, "sim-server",
      {"--scene", scene.path(), "--listen", "10.77.0.1:57300", "--allow", "10.77.0.2", "--allow",
       "10.77.0.1", "--target", "10.77.0.2:57310", "--record", told, "--record-forces"});
  ASSERT_TRUE(simulator->wait_for_text("running")) << simulator->output();
  tests::ChildProcess synth(
      hosts_.command_on(
          kSynthHost,
          tests::command("synth-server",
                         {"--rig", tests::rig_path("stereo.yaml"), "--device", "null", "--sound",
                          sound, "--listen", "10.77.0.2:57310", "--allow", "10.77.0.1", "--forces",
                          "10.77.0.1:57300", "--record-events", started})),
      {{"LD_PRELOAD", std::string(SPLASH_BINARY_DIR) + "/libclock_shim.so"},
       {"SPLASH_CLOCK_OFFSET", "3600.3"}});
  ASSERT_TRUE(synth.wait_for_text("listening: ")) << synth.output();
  protocol::UdpSocket tracker = hosts_.socket_on(kSimHost, "10.77.0.1:0");
  const double begin = protocol::monotonic_now();
  constexpr double kSeconds = 2.5;  // the synth asks at once, and knows the clock soon
  for (double t = 0.0; t < kSeconds; t = protocol::monotonic_now() - begin) {
    tracker.send_to(protocol::parse_endpoint("10.77.0.1:57300", 0),
                    protocol::encode(protocol::to_message(pose_at(t))));
    std::this_thread::sleep_for(std::chrono::milliseconds(5));
  }
  for (tests::ChildProcess* process : {simulator.get(), &synth}) {
    EXPECT_EQ(process->end(), 0) << process->output();
  }
  const Moments meant = moments_of(told);
  const Moments played = moments_of(started);
  ASSERT_GT(meant.pushes.size(), 100U) << simulator->output();
  ASSERT_GT(played.pushes.size(), 100U) << synth.output() << simulator->output();
  ASSERT_GT(played.bubbles.size(), 10U) << synth.output();

  const double bubbles_later = later(played.bubbles, meant.bubbles);
  const double pushes_later = later(played.pushes, meant.pushes);
  std::cout << played.pushes.size() << " pushes of " << meant.pushes.size() << " forces, "
            << played.bubbles.size() << " bubbles; later than in simulated time by "
            << 1e3 * pushes_later << " and " << 1e3 * bubbles_later << " ms\n";
  // A push acts from the beginning of its cell on, 0.7 ms before its force's moment on average.
  EXPECT_NEAR(pushes_later, bubbles_later, 5e-3) << "of an hour; less but under load";
}

}  // namespace
}  // namespace splash::network
