// SPDX-License-Identifier: MIT
// How the real program ends when something is wrong: the code for scripts, the words for people.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>

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

void write(const std::string& path, const std::string& text) {
  std::ofstream(path, std::ios::binary) << text;
}

TEST(Exit, NamesTheRigThatIsMissingOrWrong) {
  const End missing = run({"--rig", "/nowhere/rig.yaml"});
  EXPECT_EQ(missing.code, 66);
  EXPECT_THAT(missing.text, testing::HasSubstr("/nowhere/rig.yaml"));

  const std::string path = temporary_path("bad-rig.yaml");
  write(path, "name: x\nnonsense: 1\n");
  const End wrong = run({"--rig", path});
  std::filesystem::remove(path);
  EXPECT_EQ(wrong.code, 78);
  EXPECT_THAT(wrong.text, testing::HasSubstr("bad-rig.yaml:2:1"));
}

TEST(Exit, NamesThePortThatIsTaken) {
  const protocol::UdpSocket taken({INADDR_LOOPBACK, 0});
  const std::string endpoint = protocol::to_string(taken.local());
  const End end = run({"--rig", rig_path("stereo.yaml"), "--device", "null", "--listen", endpoint});
  EXPECT_EQ(end.code, 69);
  EXPECT_THAT(end.text, testing::HasSubstr(std::to_string(taken.local().port)));
}

TEST(Exit, NamesTheFileThatCannotBeWritten) {
  const End end = run({"--rig", rig_path("stereo.yaml"), "--device", "null", "--listen",
                       "127.0.0.1:0", "--record-audio", "/nowhere/a.wav"});
  EXPECT_EQ(end.code, 74);
  EXPECT_THAT(end.text, testing::HasSubstr("/nowhere/a.wav"));
}

TEST(Exit, NamesTheLogThatIsNone) {
  const std::string log = temporary_path("bad.osc");
  const std::string wav = temporary_path("bad.wav");
  write(log, "this is no log");
  const End bad = run({"--rig", rig_path("stereo.yaml"), "--replay", log, "--render", wav});
  std::filesystem::remove(log);
  EXPECT_EQ(bad.code, 65);
  EXPECT_THAT(bad.text, testing::HasSubstr("bad.osc"));
  EXPECT_FALSE(std::filesystem::exists(wav)) << "nothing is overwritten for a log that is none";
  EXPECT_EQ(run({"--rig", rig_path("stereo.yaml"), "--replay", log, "--render", wav}).code, 66);
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

TEST(Exit, EndsAtItsTime) {
  const End end = run({"--rig", rig_path("stereo.yaml"), "--device", "null", "--listen",
                       "127.0.0.1:0", "--duration", "0.2"});
  EXPECT_EQ(end.code, 0);
  EXPECT_THAT(end.text, testing::HasSubstr("played 0 impacts"));
}

}  // namespace
}  // namespace splash::synth
