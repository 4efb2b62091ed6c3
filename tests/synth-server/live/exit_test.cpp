// SPDX-License-Identifier: MIT
// How the real program ends: the code for scripts, the words for people, and what it leaves. What
// is wrong of both programs alike is tested in tests/system.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "protocol/event_log.hpp"
#include "tests/support/programs.hpp"
#include "tests/support/recording.hpp"
#include "tests/support/temporary_folder.hpp"

namespace splash::synth {
namespace {

using tests::onset;
using tests::peak;
using tests::Recording;
using tests::rig_path;

tests::Ended run(const tests::Arguments& arguments) {
  return tests::run_program("synth-server", arguments);
}

TEST(Exit, NamesTheFileThatCannotBeWritten) {
  const tests::Ended end = run({"--rig", rig_path("stereo.yaml"), "--device", "null", "--listen",
                                "127.0.0.1:0", "--record-audio", "/nowhere/a.wav"});
  EXPECT_EQ(end.code, 74);
  EXPECT_THAT(end.text, testing::HasSubstr("/nowhere/a.wav"));
}

TEST(Exit, RendersAReplayAndItsStems) {
  const tests::TemporaryFolder folder;
  const std::string log = folder / "replay.osc";
  const std::string wav = folder / "replay.wav";
  {
    protocol::LogWriter writer(log);
    writer.append(0.5, {protocol::to_message(protocol::Impact{1, 0, 2.0F, 2.0F, {}, 0.0F})});
    writer.append(1.0, {protocol::to_message(protocol::Bubble{2, 0, 0.01F, 0.1F, {}, 0.0F})});
    writer.append(1.5, {protocol::to_message(protocol::Cavity{3, 0, 0.05F, 0.1F, {}, 0.0F})});
  }
  const tests::Ended end =
      run({"--rig", rig_path("stereo.yaml"), "--replay", log, "--render", wav, "--stems"});
  ASSERT_EQ(end.code, 0) << end.text;
  EXPECT_THAT(end.text, testing::HasSubstr("played 1 impacts, 1 bubbles, 1 cavities"));
  const std::vector<std::pair<std::string, double>> stems{{"replay.wav", 0.5},
                                                          {"replay-impacts.wav", 0.5},
                                                          {"replay-bubbles.wav", 1.0},
                                                          {"replay-cavities.wav", 1.5}};
  for (const auto& [path, start] : stems) {
    const Recording recording = tests::read_recording(folder / path);
    const auto& left = recording.channels.at(0);
    const std::int64_t first = onset(left, 0.001F * peak(left));
    EXPECT_NEAR(static_cast<double>(first), 48000.0 * start, 480.0) << path;
  }
}

}  // namespace
}  // namespace splash::synth
