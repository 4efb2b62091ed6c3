// SPDX-License-Identifier: MIT
// A JACK server that changes under the running program: its period, its rate. And what the program
// says of its ports.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <atomic>
#include <csignal>
#include <memory>

#include "protocol/status.hpp"
#include "protocol/time_tag.hpp"
#include "synth-server/audio/rtaudio_output.hpp"
#include "tests/support/jack.hpp"
#include "tests/support/programs.hpp"
#include "tests/support/recording.hpp"
#include "tests/support/temporary_folder.hpp"
#include "tests/support/waiting.hpp"

namespace splash::synth {
namespace {

using tests::eventually;
using tests::JackCapture;
using tests::JackServer;
using tests::rig_path;
using tests::sleep;

constexpr int kPeriod = 512;
constexpr double kTimeout = 30.0;  ///< [s]

tests::Arguments arguments() {
  return {"--rig", rig_path("shoes.yaml"), "--api", "jack"};
}

/// Whether an event of each foot is heard in its shoe, and in no other.
void expect_both_shoes(tests::Synth& synth) {
  JackCapture capture("synth-server", 4, 2.5);
  for (int k = 0; k < 23; ++k) {  // the gate opens slowly
    const protocol::Bubble bubble{k, k < 15 ? 0 : 1, 0.02F, 0.1F, {0.0F, 0.0F, 0.0F}, 0.0F};
    synth.send(protocol::encode(protocol::to_message(bubble)));
    sleep(0.1);
  }
  ASSERT_TRUE(capture.wait(kTimeout)) << synth.process().output();
  const auto& channels = capture.channels();
  for (const auto& channel : channels) EXPECT_GT(tests::peak(channel), 0.01F);
  EXPECT_EQ(channels[0], channels[1]) << "heel and toe";
  EXPECT_EQ(channels[2], channels[3]);
  EXPECT_LT(tests::onset(channels[0], 0.01F), tests::onset(channels[2], 0.01F));
}

TEST(JackChanges, OfThePeriodAreFollowed) {
  const JackServer server("period", {4, kPeriod});
  tests::Synth synth(arguments());
  EXPECT_THAT(synth.process().output(), testing::HasSubstr("blocks of 512"));
  JackServer::set_period(1024);  // more than it had: what was made for 512 is too small
  ASSERT_TRUE(synth.process().wait_for_text("plays, blocks of 1024 at 48000 Hz", kTimeout))
      << synth.process().output();
  expect_both_shoes(synth);
  synth.process().signal(SIGTERM);
  EXPECT_EQ(synth.process().wait_for_end(), 0) << synth.process().output();
  EXPECT_THAT(synth.process().output(), testing::HasSubstr("1 device losses"));
  EXPECT_THAT(synth.process().output(), testing::HasSubstr("not played: 0 too late"));
}

TEST(JackChanges, OfTheRateAreFollowed) {
  auto server = std::make_unique<JackServer>("rate", JackServer::Settings{4, kPeriod});
  tests::Synth synth(arguments());
  server->kill();
  server = std::make_unique<JackServer>("rate", JackServer::Settings{4, kPeriod, 44100});
  ASSERT_TRUE(synth.process().wait_for_text("plays, blocks of 512 at 44100 Hz", kTimeout))
      << synth.process().output();
  const auto status = protocol::to_synth_status(synth.ask({"/status", {}}, "/status.reply"));
  ASSERT_TRUE(status);
  EXPECT_EQ(status->sample_rate, 44100.0F);
  expect_both_shoes(synth);
  synth.process().signal(SIGTERM);
  EXPECT_EQ(synth.process().wait_for_end(), 0) << synth.process().output();
}

/// A source that takes its time over a block.
struct Slow final : BlockSource {
  void render(const AudioBlock& block) noexcept override {
    for (int c = 0; c < 2; ++c) std::fill_n(block.channels[c], block.frames, 0.0F);
    if (entered.exchange(true)) return;
    const double limit = protocol::monotonic_now() + kTimeout;
    while (!go && protocol::monotonic_now() < limit) {
    }
    left = true;
  }
  std::atomic<bool> entered{false};
  std::atomic<bool> go{false};
  std::atomic<bool> left{false};
};

/// libjack cancels the thread that renders, wherever it is, and RtAudio closes the stream, whatever
/// its owner does.
TEST(JackChanges, ToNothingWhileABlockIsRenderedAreSurvived) {
  auto server = std::make_unique<JackServer>("midblock", JackServer::Settings{2, kPeriod});
  Slow source;
  {
    RtAudioOutput output({"jack", "system", 2, 0, kPeriod});
    output.start(source);
    EXPECT_TRUE(eventually([&] { return source.entered.load(); }));
    server->kill();
    sleep(0.5);
    EXPECT_FALSE(source.left);
    source.go = true;
    EXPECT_TRUE(eventually([&] { return source.left.load(); }));
  }
  server = std::make_unique<JackServer>(
      "midblock", JackServer::Settings{2, kPeriod});  // one that ends well leaves no trace
}

TEST(JackPorts, AreNamedInTheChannelMap) {
  const JackServer server("ports", {6, kPeriod});
  tests::Synth synth(arguments());
  EXPECT_THAT(synth.process().output(),
              testing::HasSubstr("1 left shoe/heel -> system:playback_1, "
                                 "2 left shoe/toe -> system:playback_2\n"));
  EXPECT_THAT(synth.process().output(),
              testing::HasSubstr("4 right shoe/toe -> system:playback_4\n"));
  JackCapture client("synth-server", 4, 0.1);  // what is said is what is connected
  EXPECT_TRUE(client.wait(kTimeout));
  for (int c = 0; c < 4; ++c) {
    EXPECT_TRUE(client.connected("synth-server:outport " + std::to_string(c),
                                 "system:playback_" + std::to_string(c + 1)));
  }
  EXPECT_FALSE(client.connected("synth-server:outport 0", "system:playback_2"));
}

TEST(JackPorts, AreThoseThatTheRigNames) {
  const JackServer server("named", {6, kPeriod});
  const tests::TemporaryFolder folder;
  const std::string rig =
      folder.write("named.yaml",
                   "name: named\noutputs:\n  - name: shoe\n    kind: worn\n    parts: [heel, toe]\n"
                   "    band: {low: 20, high: 750}\ndevice_channels: [5, 2]\n");
  tests::ChildProcess synth(
      tests::command("synth-server", {"--rig", rig, "--api", "jack", "--test-tone", "1"}));
  JackCapture client("synth-server", 5, 0.5);
  EXPECT_TRUE(client.wait(kTimeout));
  EXPECT_EQ(synth.wait_for_end(kTimeout), 0) << synth.output();
  EXPECT_THAT(synth.output(), testing::HasSubstr("1 shoe/heel -> system:playback_5, "
                                                 "2 shoe/toe -> system:playback_2"));
  EXPECT_GT(tests::peak(client.channels()[4]), 0.01F) << "heel";
  for (const std::size_t c : {0U, 1U, 2U, 3U}) EXPECT_EQ(tests::peak(client.channels()[c]), 0.0F);
}

}  // namespace
}  // namespace splash::synth
