// SPDX-License-Identifier: MIT
// The real program on PulseAudio, and on ALSA through its plugin: the tone of a channel arrives on
// that channel, and a server that dies and comes back is survived.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <csignal>
#include <cstdlib>
#include <cstring>
#include <filesystem>
#include <memory>
#include <stdexcept>
#include <string>
#include <vector>

#include "tests/support/child_process.hpp"
#include "tests/support/programs.hpp"
#include "tests/support/recording.hpp"
#include "tests/support/temporary_folder.hpp"
#include "tests/support/waiting.hpp"

namespace splash::synth {
namespace {

/// A PulseAudio server without hardware, in a folder of its own, with one sink that swallows all.
/// ALSA's default device leads to it as well.
class PulseServer {
 public:
  /// Programs started from now on find it: HOME, PULSE_SERVER and XDG_RUNTIME_DIR say so. Throws
  /// std::runtime_error naming the package when it does not start.
  explicit PulseServer(int channels) : channels_(channels) {
    const std::string address = "unix:" + socket_;
    setenv("HOME", folder_.path().c_str(), 1);
    setenv("XDG_RUNTIME_DIR", folder_.path().c_str(), 1);
    setenv("PULSE_SERVER", address.c_str(), 1);
    const std::string pulse = " { type pulse server \"" + address + "\" }\n";
    folder_.write(".asoundrc", "pcm.!default" + pulse + "ctl.!default" + pulse);
    start();
  }

  /// As a crash would.
  void kill() {
    server_->signal(SIGKILL);
    (void)server_->wait_for_end(5.0);
  }
  /// After kill(): anew in the same place.
  void start() {
    std::filesystem::remove(socket_);
    server_ = std::make_unique<tests::ChildProcess>(std::vector<std::string>{
        "pulseaudio", "-n", "--daemonize=no", "--exit-idle-time=-1", "--disable-shm=yes",
        "--use-pid-file=no", "--realtime=no", "--high-priority=no", "-L",
        "module-native-protocol-unix auth-anonymous=1 socket=" + socket_, "-L",
        "module-null-sink sink_name=tiles rate=48000 channels=" + std::to_string(channels_)});
    const auto answers = [] {
      return tests::ChildProcess({"pactl", "info"}).wait_for_end(5.0) == 0;
    };
    if (tests::eventually([&] { return !server_->running() || answers(); }, 20.0, 0.1) &&
        server_->running()) {
      return;
    }
    throw std::runtime_error(
        "pulseaudio did not start; is it installed ('apt install pulseaudio "
        "pulseaudio-utils')?\n" +
        server_->output());
  }

  [[nodiscard]] int channels() const noexcept { return channels_; }

 private:
  tests::TemporaryFolder folder_;
  std::string socket_ = folder_ / "native";
  int channels_;
  std::unique_ptr<tests::ChildProcess> server_;
};

/// What a server's sink hears, from its construction on.
class PulseRecording {
 public:
  /// Returns once the sink is heard. Throws std::runtime_error when it is not.
  explicit PulseRecording(const PulseServer& pulse)
      : width_(static_cast<std::size_t>(pulse.channels())),
        listener_({"parec", "--device=tiles.monitor", "--format=float32le", "--rate=48000",
                   "--latency-msec=20", "--channels=" + std::to_string(pulse.channels())}) {
    wait_for(1);
  }

  /// Waits until `more` frames came beyond those that are there; all of them, channel by channel.
  [[nodiscard]] std::vector<std::vector<float>> channels(std::size_t more) {
    wait_for(frames() + more);
    const std::string bytes = listener_.output();
    const std::size_t count = bytes.size() / (width_ * sizeof(float));
    std::vector<std::vector<float>> channels(width_, std::vector<float>(count));
    for (std::size_t i = 0; i < count * width_; ++i) {
      std::memcpy(&channels[i % width_][i / width_], bytes.data() + i * sizeof(float),
                  sizeof(float));
    }
    return channels;
  }

 private:
  [[nodiscard]] std::size_t frames() const {
    return listener_.output().size() / (width_ * sizeof(float));
  }
  void wait_for(std::size_t wanted) {
    if (tests::eventually([&] { return frames() >= wanted; }, 20.0, 0.1)) return;
    throw std::runtime_error("parec heard " + std::to_string(frames()) + " frames of " +
                             std::to_string(wanted));
  }

  std::size_t width_;
  tests::ChildProcess listener_;
};

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
