// SPDX-License-Identifier: MIT
// A simulator that is paused, and one whose scene begins anew.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <memory>
#include <vector>

#include "protocol/control.hpp"
#include "protocol/time_tag.hpp"
#include "tests/support/frame_viewer.hpp"
#include "tests/support/programs.hpp"
#include "tests/support/small_scene.hpp"
#include "tests/support/waiting.hpp"

namespace splash::tests {
namespace {

/// What a viewer is shown of the small scene.
struct Shown {
  double moment = 0.0;          ///< Unix time [s]
  double seconds = 0.0;         ///< simulated [s]
  double height = 0.0;          ///< of the disc [m]
  std::vector<double> heights;  ///< of the water's particles [m]
};

class Watched {
 public:
  Watched() : simulator_({"--scene", scene_.path(), "--show", "127.0.0.1:0"}) {
    viewer_ = std::make_unique<FrameViewer>(simulator_.viewers());
    static_cast<void>(viewer_->read());  // the scene
  }
  Shown look() const {
    viewer_->ask();
    const protocol::ViewFrame frame = viewer_->read();
    if (frame.size() < 88) return {};
    using protocol::frame_number;
    Shown shown{frame_number<double>(&frame[8]),
                frame_number<double>(&frame[16]),
                static_cast<double>(frame_number<float>(&frame[64])),
                {}};
    const auto lower = static_cast<double>(frame_number<float>(&frame[48]));
    const auto unit = static_cast<double>(frame_number<float>(&frame[52]));
    for (std::uint32_t p = 0; p < frame_number<std::uint32_t>(&frame[28]); ++p) {
      shown.heights.push_back(lower + unit * frame_number<std::uint16_t>(&frame[88 + 8 * p + 4]));
    }
    return shown;
  }
  void say(const protocol::Message& command) {
    EXPECT_EQ(simulator_.ask(command, "/done").address, "/done") << command.address;
  }
  Simulator& simulator() { return simulator_; }

 private:
  SmallScene scene_{plunging()};
  Simulator simulator_;
  std::unique_ptr<FrameViewer> viewer_;
};

TEST(Pause, TimeStandsStillWhileTheSynthGoesOnSounding) {
  Watched watched;
  protocol::UdpSocket synth(protocol::Endpoint{INADDR_LOOPBACK, 0});
  synth.send_to(watched.simulator().endpoint(),
                protocol::encode({"/notify", {1, std::string(64, 'x'), std::string(64, 'x')}}));
  for (int i = 0; i < 20; ++i) static_cast<void>(watched.look());
  watched.say({"/pause", {1}});
  sleep(0.3);
  const Shown paused = watched.look();
  sleep(0.5);
  const Shown later = watched.look();
  EXPECT_EQ(later.seconds, paused.seconds);
  EXPECT_EQ(later.heights, paused.heights);
  EXPECT_GT(later.moment, paused.moment + 0.4) << "it is shown as of now";
  std::vector<std::byte> bytes(2048);
  while (synth.receive(bytes.data(), bytes.size(), 0.0)) {
  }
  for (int i = 0; i < 5; ++i) {  // a peer is gone after 0.3 s of silence
    const auto got = synth.receive(bytes.data(), bytes.size(), 0.3);
    ASSERT_TRUE(got) << i;
    const auto read = protocol::decode(protocol::Bytes(bytes).first(got->size));
    ASSERT_EQ(read.packet.messages.size(), 1U);
    EXPECT_EQ(read.packet.messages[0].address, "/frame");
  }
  const double resumed = protocol::monotonic_now();
  watched.say({"/pause", {0}});
  const Shown after = watched.look();
  const double since = watched.look().seconds - paused.seconds;
  EXPECT_LT(since, protocol::monotonic_now() - resumed + 0.4) << "no time is caught up";
  EXPECT_GE(after.seconds, paused.seconds);
  double last = after.seconds;
  for (int i = 0; i < 50 && last < paused.seconds + 0.1; ++i) last = watched.look().seconds;
  EXPECT_GE(last, paused.seconds + 0.1);
}

TEST(Reset, WaterAndBodiesAreAsTheyWereAtTheStart) {
  Watched watched;
  watched.say({"/pause", {1}});
  watched.say({"/reset", {}});
  sleep(0.2);
  const Shown start = watched.look();
  watched.say({"/pause", {0}});
  double lowest = 1.0;
  for (int i = 0; i < 200 && lowest > 0.12; ++i) lowest = std::min(lowest, watched.look().height);
  EXPECT_LT(lowest, 0.12) << "the disc has plunged";
  watched.say({"/pause", {1}});
  sleep(0.2);
  const Shown splashed = watched.look();
  EXPECT_NE(splashed.heights, start.heights);
  watched.say({"/reset", {}});
  sleep(0.2);
  const Shown again = watched.look();
  EXPECT_NEAR(again.height, SmallScene::kRest, 1e-6);
  EXPECT_EQ(again.seconds, splashed.seconds) << "simulated time goes on";
  ASSERT_EQ(again.heights.size(), start.heights.size());
  for (std::size_t p = 0; p < start.heights.size(); ++p) {
    ASSERT_NEAR(again.heights[p], start.heights[p], 1e-5) << p;
  }
  // The script begins anew: down to the water within 0.4 s.
  watched.say({"/pause", {0}});
  lowest = 1.0;
  Shown now = again;
  while (now.seconds < again.seconds + 0.45) {
    now = watched.look();
    if (now.heights.empty()) break;
    lowest = std::min(lowest, now.height);
    if (now.seconds < again.seconds + 0.1) {
      EXPECT_GT(now.height, 0.28);
    }
  }
  EXPECT_LT(lowest, 0.12);
}

}  // namespace
}  // namespace splash::tests
