// SPDX-License-Identifier: MIT
// Either program dies while the other runs, and comes back: nothing is lost but the time between.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <csignal>
#include <filesystem>

#include "protocol/status.hpp"
#include "protocol/time_tag.hpp"
#include "tests/support/programs.hpp"
#include "tests/support/recording.hpp"
#include "tests/support/waiting.hpp"
#include "tests/system/small_scene.hpp"

namespace splash::tests {
namespace {

constexpr double kTimeout = 30.0;  // [s]

Arguments synth_on(const std::string& listen) {
  return {"--rig", rig_path("stereo.yaml"), "--device", "null", "--listen", listen};
}

Arguments simulator_to(const SmallScene& scene, const protocol::Endpoint& target) {
  return {"--scene", scene.path(), "--target", protocol::to_string(target)};
}

/// The synth's status when it has taken `events` more than `before`, or when limits ends.
protocol::SynthStatus status_after(Synth& synth, std::uint64_t before, std::uint64_t events) {
  protocol::SynthStatus status;
  const double limit = protocol::monotonic_now() + kTimeout;
  do {
    status = protocol::to_synth_status(synth.ask({"/status", {}}, "/status.reply"))
                 .value_or(protocol::SynthStatus{});
    if (status.events >= before + events) break;
    sleep(0.05);
  } while (protocol::monotonic_now() < limit);
  EXPECT_GE(status.events, before + events);
  return status;
}

void kill_at_once(ChildProcess& process) {
  process.signal(SIGKILL);
  EXPECT_EQ(process.wait_for_end(), 128 + SIGKILL);
}

TEST(Restart, OfTheSynthUnderARunningSimulator) {
  const SmallScene scene(plunging());
  auto synth = std::make_unique<Synth>(synth_on("127.0.0.1:0"));
  const protocol::Endpoint port = synth->endpoint();
  Simulator simulator(simulator_to(scene, port));
  EXPECT_EQ(status_after(*synth, 0, 10).lost, 0U);
  kill_at_once(synth->process());
  sleep(0.5);
  ASSERT_TRUE(simulator.process().running()) << simulator.process().output();
  synth = std::make_unique<Synth>(synth_on(protocol::to_string(port)));
  const auto status = status_after(*synth, 0, 10);
  EXPECT_EQ(status.lost, 0U) << "what was said before it came is nobody's loss";
  EXPECT_EQ(status.duplicates, 0U);
  simulator.process().signal(SIGTERM);
  EXPECT_EQ(simulator.process().wait_for_end(), 0);
  EXPECT_THAT(simulator.process().output(), testing::HasSubstr(", lost 0,"));
}

/// The longest run of exact zeros between two sounds [samples].
std::int64_t longest_pause(const std::vector<float>& channel) {
  std::int64_t longest = 0;
  std::int64_t last = -1;
  for (std::size_t i = 0; i < channel.size(); ++i) {
    if (channel[i] == 0.0F) continue;
    const auto at = static_cast<std::int64_t>(i);
    if (last >= 0) longest = std::max(longest, at - last - 1);
    last = at;
  }
  return longest;
}

TEST(Restart, OfTheSimulatorUnderARunningSynth) {
  constexpr double kPause = 2.5;  // [s]
  const SmallScene scene(plunging());
  const std::string wav = temporary_path("restart.wav");
  Arguments arguments = synth_on("127.0.0.1:0");
  arguments.insert(arguments.end(), {"--record-audio", wav});
  Synth synth(arguments);
  auto simulator = std::make_unique<Simulator>(simulator_to(scene, synth.endpoint()));
  sleep(2.5);  // the engine opens slowly at its start
  const auto first = status_after(synth, 0, 20);
  kill_at_once(simulator->process());
  sleep(kPause);
  simulator = std::make_unique<Simulator>(simulator_to(scene, synth.endpoint()));
  const auto second = status_after(synth, first.events, 20);
  EXPECT_EQ(second.lost, 0U);
  EXPECT_EQ(second.duplicates, 0U);
  EXPECT_EQ(second.refused, 0U);
  synth.process().signal(SIGTERM);
  EXPECT_EQ(synth.process().wait_for_end(), 0);
  const std::string text = synth.process().output();
  EXPECT_EQ(number_before(text, "sessions"), 2) << text;
  EXPECT_GE(number_before(text, "departures"), 1) << text;

  const Recording recording = read_recording(wav);
  const auto& left = recording.channels.at(0);
  // What sounds rings out, for less than a second; a starved machine may have taken longer.
  EXPECT_GE(longest_pause(left), static_cast<std::int64_t>(0.5 * kPause * recording.sample_rate));
  const auto frames = static_cast<std::int64_t>(left.size());
  EXPECT_GT(peak(left, frames - recording.sample_rate), 0.0F) << "it sounds again";
  std::filesystem::remove(wav);
}

}  // namespace
}  // namespace splash::tests
