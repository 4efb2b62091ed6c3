// SPDX-License-Identifier: MIT
// What the page sends while a body is held, received by a simulator that the test plays.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <thread>
#include <vector>

#include "protocol/frame_stream.hpp"
#include "protocol/limits.hpp"
#include "protocol/message.hpp"
#include "protocol/time_tag.hpp"
#include "tests/view/chromium.hpp"
#include "view-server/server.hpp"

namespace splash::tests {
namespace {

protocol::ViewFrame no_frame(std::string_view kind) {
  return protocol::FrameWriter(kind, 0.0).take();
}

constexpr double kTimeout = 60.0;  ///< [s]

struct Pose {
  double made = 0.0;  ///< by the page's clock, Unix time [s]
  double x = 0.0;     ///< [m]
};

class Poses : public testing::Test {
 protected:
  void SetUp() override {
    if (!Chromium::is_there()) GTEST_SKIP() << "there is no chromium: apt-get install chromium";
  }

  /// The first so many poses of body 3, or those that come in time.
  std::vector<Pose> receive(std::size_t count) {
    std::vector<Pose> poses;
    std::array<std::byte, protocol::kMaxDatagram> buffer{};
    const double end = protocol::monotonic_now() + kTimeout;
    while (poses.size() < count && protocol::monotonic_now() < end) {
      const auto got = sim_.receive(buffer.data(), buffer.size(), 0.1);
      if (!got) continue;
      const auto read = protocol::decode({buffer.data(), got->size});
      if (!read.packet.time || read.packet.messages.empty()) continue;
      const auto pose = protocol::to_body_pose(read.packet.messages.front());
      if (!pose || pose->body != 3) continue;
      poses.push_back(
          {protocol::to_unix_seconds(*read.packet.time), static_cast<double>(pose->position.x)});
    }
    return poses;
  }

  protocol::FrameStream water_{{}, no_frame(protocol::kSceneFrame)};
  protocol::FrameStream sound_{{.listen = {}, .allowed = {}, .most_asked = 16},
                               no_frame(protocol::kRigFrame)};
  protocol::UdpSocket sim_{protocol::Endpoint{}};
  protocol::UdpSocket synth_{protocol::Endpoint{}};
  view::Server server_{{.listen = {},
                        .sim = sim_.local(),
                        .synth = synth_.local(),
                        .sim_show = water_.local(),
                        .synth_show = sound_.local(),
                        .origins = {}}};
  std::jthread thread_{[this] { server_.run(); }};
  std::shared_ptr<void> stop_{nullptr, [this](void*) { server_.stop(); }};
};

// A hand at 0.5 m/s of which the browser tells in heaps of three, 8 ms between them, each heap when
// its last has come. The page's clock and timers are the test's: two seconds of them, however long
// the machine takes for it.
TEST_F(Poses, AreEvenHoweverTheBrowserTellsOfTheHand) {
  Chromium browser;
  browser.call("Page.navigate",
               {{"url", "http://" + protocol::to_string(server_.local()) + "/vector.js"}});
  browser.evaluate(R"((async () => {
    const rest = () => new Promise((done) => setTimeout(done, 1));
    const { Link } = await import('/link.js');
    const { Grabs } = await import('/grab.js');
    const nothing = () => {};
    const link = new Link({ open: nothing, closed: nothing, told: nothing, osc: nothing,
      SPC1: nothing, SPR1: nothing });
    while (!link.isOpen) await rest();
    let now = performance.now(); // [ms]
    performance.now = () => now;
    const timers = [];
    const setInterval = window.setInterval;
    window.setInterval = (act, period) => timers.push({ act, period, next: now + period });
    const grabs = new Grabs(link);
    window.setInterval = setInterval;
    grabs.bound({ lower: [-5, -5, -5], upper: [5, 5, 5] });
    grabs.take('test', 3, [0, 0, 0], [0, 0, 0, 1]);
    const start = now / 1000;
    for (let told = 1; told <= 250; ++told) {
      const moment = start + told * 0.008;
      for (const end = 1000 * moment; now < end; now = Math.min(now + 1, end)) {
        for (const timer of timers) {
          for (; timer.next <= now; timer.next += timer.period) timer.act();
        }
      }
      if (told % 3 !== 0) continue;
      for (const then of [moment - 0.016, moment - 0.008, moment]) {
        grabs.move('test', [0.5 * (then - start), 0, 0], undefined, then);
      }
      await rest();
    }
  })())");
  const std::vector<Pose> poses = receive(190);
  ASSERT_EQ(poses.size(), 190U);
  double worst = 0.0;
  for (std::size_t i = 1; i < poses.size(); ++i) {
    EXPECT_NEAR(poses[i].made - poses[i - 1].made, 0.01, 1e-6) << i;
    if (i < poses.size() / 2) continue;  // the filter has settled
    const double speed = (poses[i].x - poses[i - 1].x) / (poses[i].made - poses[i - 1].made);
    worst = std::max(worst, std::abs(speed - 0.5));
  }
  EXPECT_LT(worst, 0.05);
  RecordProperty("worst_speed", std::to_string(worst));
}

}  // namespace
}  // namespace splash::tests
