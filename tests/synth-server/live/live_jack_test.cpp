// SPDX-License-Identifier: MIT
// The real program on a real JACK server with 36 channels and no hardware: what each channel plays
// live is what the offline rendering of the same events says, and a server's death is survived.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <csignal>

#include "synth-server/output/rig_reader.hpp"
#include "synth-server/replay/replay.hpp"
#include "tests/support/jack.hpp"
#include "tests/support/programs.hpp"
#include "tests/support/recording.hpp"
#include "tests/support/waiting.hpp"

namespace splash::synth {
namespace {

using protocol::Message;
using tests::JackCapture;
using tests::JackServer;
using tests::onset;
using tests::peak;
using tests::rig_path;
using tests::sleep;

constexpr int kChannels = 36;
/// The dummy driver has no interrupt, only sleep: a long period makes it steady [frames].
constexpr int kPeriod = 1024;
/// On a busy machine one this long is seldom late.
constexpr int kLongPeriod = 8192;
constexpr double kOpening = 2.2;  ///< the engine opens slowly at its start [s]
constexpr double kTake = 2.5;     ///< [s]
constexpr int kMostTakes = 8;

/// All at the same moment, so that the rate a live clock estimates does not matter: a bubble over
/// tile 0, a bubble over tile 35, an impact over tile 14, each alone in its corner of the floor.
std::vector<Message> events() {
  const auto over = [](int column, int row) {
    return protocol::Vec3{0.305F * (static_cast<float>(column) + 0.5F),
                          0.305F * (static_cast<float>(row) + 0.5F), 0.0F};
  };
  return {protocol::to_message(protocol::Bubble{1, 0, 0.010F, 0.05F, over(0, 0), 0.0F}),
          protocol::to_message(protocol::Bubble{2, 0, 0.020F, 0.02F, over(5, 5), 0.0F}),
          protocol::to_message(protocol::Impact{3, 0, 2.0F, 2.0F, over(2, 2), 0.0F})};
}

std::vector<std::vector<float>> rendered_offline() {
  std::vector<std::vector<float>> channels(kChannels);
  ReplaySettings settings;
  settings.tail = 1.0;
  (void)replay({{0.1, events()}}, read_rig(rig_path("tiles36.yaml")), settings,
               [&](const float* const* block, int frames) {
                 for (std::size_t c = 0; c < kChannels; ++c) {
                   channels[c].insert(channels[c].end(), block[c], block[c] + frames);
                 }
               });
  return channels;
}

std::vector<std::string> arguments() {
  return {"--rig", rig_path("tiles36.yaml"), "--api", "jack"};
}

/// Records one take of the events; unless `torn` will do, empty when samples are missing because
/// the server was late.
std::vector<std::vector<float>> take(tests::Synth& synth, bool torn = false) {
  JackCapture capture("synth-server", kChannels, kTake);
  sleep(0.5);
  const int before = capture.xruns();
  synth.send(protocol::encode(protocol::to_time_tag(protocol::unix_now() + 0.3), events()));
  if (!capture.wait(20.0)) throw std::runtime_error("JACK stopped while it was recorded");
  if (!torn && capture.xruns() != before) return {};
  return capture.channels();
}

/// First sample of any channel that passes a hundredth of the loudest.
std::int64_t start_of(const std::vector<std::vector<float>>& channels, float loudest) {
  std::int64_t first = -1;
  for (const auto& channel : channels) {
    const std::int64_t at = onset(channel, 0.01F * loudest);
    if (at >= 0 && (first < 0 || at < first)) first = at;
  }
  return first;
}

float loudest_of(const std::vector<std::vector<float>>& channels) {
  float loudest = 0.0F;
  for (const auto& channel : channels) loudest = std::max(loudest, peak(channel));
  return loudest;
}

/// The first take in which no samples are missing; empty without any.
std::vector<std::vector<float>> whole_take(int period) {
  const JackServer server("channels", {kChannels, period});
  tests::Synth synth(arguments());
  EXPECT_THAT(synth.process().output(),
              testing::HasSubstr("output: jack device 'system', 36 channels at 48000 Hz"));
  sleep(kOpening);
  std::vector<std::vector<float>> live;
  for (int i = 0; i < kMostTakes && live.empty(); ++i) live = take(synth);
  return live;
}

TEST(LiveJack, PlaysEachChannelAsTheOfflineRendering) {
  std::vector<std::vector<float>> live = whole_take(kPeriod);
  if (live.empty()) live = whole_take(kLongPeriod);
  ASSERT_FALSE(live.empty()) << "each take had xruns: the machine is too busy to record";

  const auto offline = rendered_offline();
  const float loudest = loudest_of(offline);
  ASSERT_GT(loudest, 0.01F);
  const std::int64_t start = start_of(offline, loudest);
  const std::int64_t live_start = start_of(live, loudest);
  ASSERT_GT(live_start, 1000);
  int sounding = 0;
  for (std::size_t c = 0; c < kChannels; ++c) {
    sounding += peak(offline[c]) > 0.0F ? 1 : 0;
    float worst = 0.0F;
    for (std::int64_t i = 0; i < 24000; ++i) {  // half a second from 1000 samples before the start
      const float is = live[c].at(static_cast<std::size_t>(live_start - 1000 + i));
      const float should_be = offline[c].at(static_cast<std::size_t>(start - 1000 + i));
      worst = std::max(worst, std::abs(is - should_be));
    }
    EXPECT_LT(worst, 1e-6F) << "channel " << c + 1;
    if (peak(offline[c]) == 0.0F) {
      EXPECT_EQ(peak(live[c]), 0.0F) << "channel " << c + 1 << " has nothing to play";
    }
  }
  EXPECT_GE(sounding, 3);
  EXPECT_LE(sounding, kChannels - 6) << "else the test does not tell channels apart";
  for (const std::size_t c : {0U, 14U, 35U}) EXPECT_GT(peak(offline[c]), 0.0F);
}

TEST(LiveJack, NamesTheDevicesWhenItIsAskedForAnother) {
  const JackServer server("names", {kChannels, kPeriod});
  const auto [code, list] = tests::run_program("synth-server", {"--list-devices"});
  EXPECT_EQ(code, 0);
  EXPECT_THAT(list, testing::HasSubstr("jack: 'system', 36 outputs, prefers 48000 Hz"));
  const auto other = tests::run_program(
      "synth-server",
      {"--rig", rig_path("tiles36.yaml"), "--listen", "127.0.0.1:0", "--device", "Fireface"});
  EXPECT_EQ(other.code, 69);
  EXPECT_THAT(other.text, testing::HasSubstr("jack: system"));
}

TEST(LiveJack, SaysThatADeviceHasTooFewChannels) {
  const JackServer server("few", {2, kPeriod});
  tests::Synth synth(arguments());
  EXPECT_THAT(synth.process().output(), testing::HasSubstr("has 2 output channels"));
  EXPECT_THAT(synth.process().output(), testing::HasSubstr("output: none"));
}

TEST(LiveJack, SaysThatTheServerHasAnotherRate) {
  const JackServer server("rate", {2, kPeriod});
  const auto [code, text] = tests::run_program(
      "synth-server", {"--rig", rig_path("stereo.yaml"), "--listen", "127.0.0.1:0", "--api", "jack",
                       "--sample-rate", "44100", "--duration", "0.2"});
  EXPECT_EQ(code, 0);
  EXPECT_THAT(text, testing::HasSubstr("jack device 'system' runs at 48000 Hz, and --sample-rate "
                                       "asks for 44100 Hz: leave --sample-rate out"));
}

TEST(LiveJack, WithoutAServerSaysWhatToStart) {
  const tests::ChildProcess::Environment nowhere = {{"JACK_DEFAULT_SERVER", "splash-nowhere"}};
  const auto list =
      tests::run_program("synth-server", {"--list-devices", "--api", "jack"}, 60.0, nowhere);
  EXPECT_EQ(list.code, 0);
  EXPECT_THAT(list.text, testing::StartsWith("no JACK server is running"));
  const auto [code, text] =
      tests::run_program("synth-server",
                         {"--rig", rig_path("stereo.yaml"), "--listen", "127.0.0.1:0", "--api",
                          "jack", "--device", "Fireface", "--duration", "0.2"},
                         60.0, nowhere);
  EXPECT_EQ(code, 0) << "one may come";
  EXPECT_THAT(text, testing::AllOf(testing::HasSubstr(
                                       "there is no device 'Fireface': no JACK server is "
                                       "running for this user: start one, with 'jackd -d alsa'"),
                                   testing::HasSubstr("Until then nothing is heard")));
}

TEST(LiveJack, SurvivesTheDeathOfItsServerAndPlaysAgain) {
  auto server = std::make_unique<JackServer>("death", JackServer::Settings{kChannels, kPeriod});
  tests::Synth synth(arguments());
  sleep(0.5);
  server->kill();
  ASSERT_TRUE(synth.process().wait_for_text("has stopped asking for sound", 20.0))
      << synth.process().output();
  EXPECT_TRUE(synth.process().wait_for_text("no JACK server is running", 20.0))
      << synth.process().output();
  ASSERT_TRUE(synth.process().running());
  EXPECT_EQ(synth.ask({"/sync", {1}}, "/synced").address, "/synced") << "it still answers";
  server = std::make_unique<JackServer>("death", JackServer::Settings{kChannels, kPeriod});
  ASSERT_TRUE(synth.process().wait_for_text("'system' plays", 20.0)) << synth.process().output();
  sleep(kOpening);
  float heard = 0.0F;
  for (int i = 0; i < kMostTakes && heard == 0.0F; ++i) heard = loudest_of(take(synth, true));
  EXPECT_GT(heard, 0.01F);
  synth.process().signal(SIGTERM);
  EXPECT_EQ(synth.process().wait_for_end(), 0) << synth.process().output();
  // A machine that stands still for half a second is another loss.
  EXPECT_THAT(synth.process().output(), testing::ContainsRegex(", [1-9][0-9]* device losses"));
}

}  // namespace
}  // namespace splash::synth
