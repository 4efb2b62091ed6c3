// SPDX-License-Identifier: MIT
// How the real program ends: the code for scripts, the words for people, and what it leaves. What
// is wrong of both programs alike is tested in tests/system.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <filesystem>

#include "protocol/event_log.hpp"
#include "tests/support/programs.hpp"
#include "tests/support/recording.hpp"

namespace splash::synth {
namespace {

using tests::onset;
using tests::peak;
using tests::Recording;
using tests::rig_path;
using tests::temporary_path;
using End = tests::Ended;

End run(const tests::Arguments& arguments) {
  return tests::run_program("synth-server", arguments);
}

TEST(Exit, NamesTheFileThatCannotBeWritten) {
  const End end = run({"--rig", rig_path("stereo.yaml"), "--device", "null", "--listen",
                       "127.0.0.1:0", "--record-audio", "/nowhere/a.wav"});
  EXPECT_EQ(end.code, 74);
  EXPECT_THAT(end.text, testing::HasSubstr("/nowhere/a.wav"));
}

TEST(Exit, RendersAReplayAndItsStems) {
  const std::string log = temporary_path("replay.osc");
  const std::string wav = temporary_path("replay.wav");
  {
    protocol::LogWriter writer(log);
    writer.append(0.5, {protocol::to_message(protocol::Impact{1, 0, 2.0F, 2.0F, {}, 0.0F})});
    writer.append(1.0, {protocol::to_message(protocol::Bubble{2, 0, 0.01F, 0.1F, {}, 0.0F})});
    writer.append(1.5, {protocol::to_message(protocol::Cavity{3, 0, 0.05F, 0.1F, {}, 0.0F})});
  }
  const End end =
      run({"--rig", rig_path("stereo.yaml"), "--replay", log, "--render", wav, "--stems"});
  ASSERT_EQ(end.code, 0) << end.text;
  EXPECT_THAT(end.text, testing::HasSubstr("played 1 impacts, 1 bubbles, 1 cavities"));
  const std::string base = wav.substr(0, wav.size() - 4);
  const std::vector<std::pair<std::string, double>> stems{{base + ".wav", 0.5},
                                                          {base + "-impacts.wav", 0.5},
                                                          {base + "-bubbles.wav", 1.0},
                                                          {base + "-cavities.wav", 1.5}};
  for (const auto& [path, start] : stems) {
    const Recording recording = tests::read_recording(path);
    const auto& left = recording.channels.at(0);
    const std::int64_t first = onset(left, 0.001F * peak(left));
    EXPECT_NEAR(static_cast<double>(first), 48000.0 * start, 480.0) << path;
    std::filesystem::remove(path);
  }
  std::filesystem::remove(log);
}

}  // namespace
}  // namespace splash::synth
