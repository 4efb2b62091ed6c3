// SPDX-License-Identifier: MIT
// The real program on PulseAudio, and on ALSA through its plugin: the tone of a channel arrives on
// that channel, and a server that dies and comes back is survived.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <csignal>

#include "tests/support/programs.hpp"
#include "tests/support/recording.hpp"
#include "tests/synth-server/live/pulse_server.hpp"

namespace splash::synth {
namespace {

using tests::peak;
using tests::rig_path;

constexpr std::size_t kBehind = 9600;  ///< 0.2 s
constexpr double kTimeout = 40.0;      ///< [s]
constexpr int kTries = 5;
constexpr float kTone = 0.09F;     ///< the tone's amplitude [full scale]
constexpr float kAround = 0.005F;  ///< what is heard of it may differ by so much

tests::Arguments tone(const std::string& rig, const std::string& api, const std::string& channel) {
  return tests::command("synth-server",
                        {"--rig", rig_path(rig), "--api", api, "--test-tone", channel});
}

/// Plays the tone again and again until the sink hears all of its level, for Pulse may drop some of
/// it. It is recorded from before the program starts until behind its end: how long either takes to
/// start does not matter.
std::vector<std::vector<float>> heard(const PulseServer& pulse, const tests::Arguments& command,
                                      std::string& output) {
  std::vector<std::vector<float>> channels;
  float loudest = 0.0F;
  for (int k = 0; k < kTries && loudest < kTone - kAround; ++k) {
    PulseRecording recording(pulse);
    tests::ChildProcess program(command);
    EXPECT_EQ(program.wait_for_end(kTimeout), 0) << program.output();
    output = program.output();
    channels = recording.channels(kBehind);
    for (const auto& channel : channels) loudest = std::max(loudest, peak(channel));
  }
  return channels;
}

TEST(Pulse, PlaysEachToneOnItsChannel) {
  const PulseServer pulse(4);
  std::string output;
  const auto channels = heard(pulse, tone("shoes.yaml", "pulse", "3"), output);
  EXPECT_THAT(output, testing::HasSubstr("output: pulse device 'Null Output', 4 channels"));
  EXPECT_THAT(output, testing::HasSubstr("heard nothing? The tones are soft"));
  ASSERT_EQ(channels.size(), 4U);
  EXPECT_NEAR(peak(channels[2]), kTone, kAround) << output;
  for (const std::size_t c : {0U, 1U, 3U}) EXPECT_LT(peak(channels[c]), 1e-4F) << c;
}

TEST(Alsa, PlaysThroughItsDefaultDevice) {
  const PulseServer pulse(2);
  std::string output;
  const auto channels = heard(pulse, tone("stereo.yaml", "alsa", "1"), output);
  EXPECT_THAT(output,
              testing::AnyOf(  // RtAudio 5's name and 6's
                  testing::HasSubstr("output: alsa device 'default', 2 channels"),
                  testing::HasSubstr("output: alsa device 'Default ALSA Device', 2 channels")));
  ASSERT_EQ(channels.size(), 2U);
  EXPECT_NEAR(peak(channels[0]), kTone, kAround) << output;
  EXPECT_LT(peak(channels[1]), 1e-3F);
}

class Lost : public testing::TestWithParam<const char*> {};

TEST_P(Lost, ServersAreSurvivedAndTakenBack) {
  PulseServer pulse(2);
  tests::Synth synth({"--rig", rig_path("stereo.yaml"), "--api", GetParam()});
  ASSERT_THAT(synth.process().output(),
              testing::HasSubstr(std::string("output: ") + GetParam() + " device"));
  pulse.kill();
  ASSERT_TRUE(synth.process().wait_for_text("going on without it", kTimeout))
      << synth.process().output();
  EXPECT_EQ(synth.ask({"/sync", {7}}, "/synced").address, "/synced") << "it still answers";
  pulse.start();
  ASSERT_TRUE(synth.process().wait_for_text("plays, blocks of", kTimeout))
      << synth.process().output();
  synth.process().signal(SIGTERM);
  EXPECT_EQ(synth.process().wait_for_end(), 0) << synth.process().output();
  EXPECT_THAT(synth.process().output(), testing::HasSubstr("1 device losses"));
}

INSTANTIATE_TEST_SUITE_P(Apis, Lost, testing::Values("pulse", "alsa"),
                         [](const auto& api) { return std::string(api.param); });

}  // namespace
}  // namespace splash::synth
