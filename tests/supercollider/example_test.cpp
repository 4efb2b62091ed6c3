// SPDX-License-Identifier: MIT
// examples/supercollider/splash.scd in synth-server's place: what it renders of recorded logs is
// what synth-server renders, and live it orders each voice for its moment. sclang and scsynth are
// the real ones; live, the test stands in for scsynth.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <csignal>
#include <fstream>
#include <iostream>
#include <string>

#include "pd-patches/event_list.hpp"
#include "protocol/control.hpp"
#include "protocol/message.hpp"
#include "protocol/time_tag.hpp"
#include "protocol/udp_socket.hpp"
#include "tests/pd-patches/rendering.hpp"
#include "tests/support/child_process.hpp"
#include "tests/support/recording.hpp"
#include "tests/support/temporary_folder.hpp"

namespace splash::supercollider {
namespace {

using pd::Channels;

constexpr std::int64_t kFrames = 216000;  ///< of a log [samples at 48 kHz]
constexpr double kTimeout = 120.0;        ///< on a busy machine [s]
constexpr double kTolerance = -60.0;      ///< largest difference re the peak [dB]
constexpr double kAdvance = 0.05;         ///< as the example has it [s]
constexpr double kControlBlock = 64.0 / 48000.0;

constexpr const char* kMissing =
    "sclang is not installed (apt-get install supercollider-language): examples/supercollider is "
    "not tried";

bool has_sclang() {
  return tests::ChildProcess({"sh", "-c", "command -v sclang"}).wait(10.0) == 0;
}

std::string example() {
  return std::string(SPLASH_SOURCE_DIR) + "/examples/supercollider/splash.scd";
}

/// Qt has no screen here.
tests::ChildProcess::Environment headless() {
  return {{"QT_QPA_PLATFORM", "offscreen"}, {"QTWEBENGINE_DISABLE_SANDBOX", "1"}};
}

Channels render_with_sclang(const std::vector<protocol::LogEntry>& log) {
  const tests::TemporaryFolder folder;
  const auto list = folder / "events.txt";
  const auto wav = folder / "out.wav";
  std::ofstream file(list);
  pd::write_event_list(log, pd::kRate, file);
  file.close();
  tests::ChildProcess sclang(
      {"sclang", example(), list.string(), wav.string(), std::to_string(kFrames)}, headless());
  const auto status = sclang.wait(kTimeout);
  if (status != 0) throw std::runtime_error("sclang: " + sclang.output());
  Channels channels = tests::read_recording(wav.string()).channels;
  for (auto& channel : channels) channel.resize(kFrames);
  return channels;
}

TEST(Example, PlaysTheBubblesAndCavitiesOfALogAsTheSynthDoes) {
  if (!has_sclang()) GTEST_SKIP() << kMissing;
  const auto log =
      pd::tones(protocol::read_log(std::string(SPLASH_SOURCE_DIR) + "/tests/data/plunge.osc"),
                static_cast<double>(kFrames) / pd::kRate - 0.5);
  const Channels synth = render_with_synth(log, pd::kStereo, kFrames);
  const double peak = pd::loudest(synth);
  ASSERT_GT(peak, 0.05);
  ASSERT_LT(peak, 0.89) << "a limiter acts: these cannot be compared";
  const Channels example = render_with_sclang(log);
  const double level = pd::decibels(pd::largest_difference(synth, example) / peak);
  std::cout << "plunge: " << level << " dB re its peak\n";
  EXPECT_LT(level, kTolerance);
}

TEST(Example, StartsImpactsWithinAControlBlock) {
  if (!has_sclang()) GTEST_SKIP() << kMissing;
  const std::vector<std::int64_t> samples = {1000, 40063, 80064, 120001};
  std::vector<pd::EventAt> events;
  for (const std::int64_t sample : samples) {
    events.push_back({static_cast<double>(sample) / pd::kRate,
                      protocol::Impact{1, 0, 1.0F, 1.0F, {0.0F, 0.0F, 0.0F}, 0.0F}});
  }
  const Channels example = render_with_sclang(pd::make_log(events));
  for (const std::int64_t sample : samples) {
    const auto from = example[0].begin() + sample - 200;
    const std::vector<float> around(from, from + 600);
    const std::int64_t start = pd::first_beyond(around, 1e-5) - 200;  // the last one has died away
    EXPECT_GE(start, 0) << sample;
    EXPECT_LE(start, 64) << sample;
  }
}

/// scsynth's end of the wire: raw, since orders have arrays, which the gate refuses.
class StandIn {
 public:
  [[nodiscard]] std::string address() const {
    return "127.0.0.1:" + std::to_string(socket_.local().port);
  }
  /// The next packet that holds `text`; empty: none came. Answers /sync meanwhile.
  std::string await(const std::string& text, double seconds) {
    std::array<std::byte, 65536> buffer{};
    const double end = protocol::monotonic_now() + seconds;
    while (protocol::monotonic_now() < end) {
      const auto received = socket_.receive(buffer.data(), buffer.size(), 0.05);
      if (!received) continue;
      const std::string packet(reinterpret_cast<const char*>(buffer.data()), received->size);
      if (packet.find("/sync") != std::string::npos) {
        std::int32_t id = 0;
        for (const char letter : packet.substr(packet.size() - 4)) {
          id = id << 8 | static_cast<std::int32_t>(static_cast<unsigned char>(letter));
        }
        (void)socket_.send_to(received->from, protocol::encode(protocol::synced(id)));
      }
      if (packet.find(text) != std::string::npos) return packet;
    }
    return {};
  }
  void send(const protocol::Endpoint& to, const std::vector<std::byte>& packet) {
    (void)socket_.send_to(to, packet);
  }

 private:
  protocol::UdpSocket socket_{{INADDR_LOOPBACK, 0}};
};

/// When a bundle is due [s since 1970].
double moment_of(const std::string& bundle) {
  std::uint64_t tag = 0;
  for (const char letter : bundle.substr(8, 8)) {
    tag = tag << 8U | static_cast<unsigned char>(letter);
  }
  return protocol::to_unix_seconds(protocol::TimeTag{tag});
}

TEST(Example, OrdersLiveVoicesForTheirMomentOnce) {
  if (!has_sclang()) GTEST_SKIP() << kMissing;
  StandIn scsynth;
  const protocol::Endpoint port = protocol::UdpSocket({INADDR_LOOPBACK, 0}).local();
  auto environment = headless();
  environment.push_back({"SPLASH_SCSYNTH", scsynth.address()});
  environment.push_back({"SPLASH_PORT", std::to_string(port.port)});
  tests::ChildProcess sclang({"sclang", example()}, environment);
  ASSERT_FALSE(scsynth.await("/s_new", kTimeout).empty()) << sclang.output();
  const double moment = protocol::unix_now() + 2.0;
  const auto bundle = protocol::encode(
      protocol::to_time_tag(moment),
      {protocol::to_message(protocol::Frame{1, 0, 0, 0.0F}),
       protocol::to_message(protocol::Bubble{1, 0, 0.01F, 0.05F, {0.0F, 0.0F, 0.0F}, 2.5F})});
  for (int twice = 0; twice < 2; ++twice) scsynth.send(port, bundle);
  const std::string order = scsynth.await("splashTone", 10.0);
  ASSERT_TRUE(order.starts_with("#bundle")) << sclang.output();
  EXPECT_NEAR(moment_of(order), moment + 0.0025 + kAdvance, kControlBlock);
  EXPECT_EQ(scsynth.await("splashTone", 1.0), "") << "it was sent twice, and is played once";
  sclang.signal(SIGKILL);
}

}  // namespace
}  // namespace splash::supercollider
