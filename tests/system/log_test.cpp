// SPDX-License-Identifier: MIT
// The event log: the same seed writes the same bytes, its replay gives the same bits, and others'
// tools read it.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <filesystem>

#include "protocol/event_log.hpp"
#include "tests/support/programs.hpp"
#include "tests/support/recording.hpp"
#include "tests/support/small_scene.hpp"
#include "tests/support/temporary_folder.hpp"
#include "tests/support/text_of.hpp"

namespace splash::tests {
namespace {

class Log : public testing::Test {
 protected:
  [[nodiscard]] std::string file(const std::string& name) const { return folder_ / name; }

  /// Three seconds of plunging; the path of their log.
  std::string record(const std::string& name, int seed = 1,
                     const ChildProcess::Environment& environment = {}) {
    const SmallScene scene(plunging(), seed);
    std::string log = file(name);
    const auto [code, text] = simulate(scene.path(), 3.0, {"--record", log}, environment);
    EXPECT_EQ(code, 0) << text;
    told_ = text;
    return log;
  }

  /// What the last recording program said.
  [[nodiscard]] const std::string& told() const noexcept { return told_; }

  std::string render(const std::string& log, const std::string& name) {
    std::string wav = file(name);
    const auto [code, text] = run_program(
        "synth-server", {"--rig", rig_path("handheld.yaml"), "--replay", log, "--render", wav});
    EXPECT_EQ(code, 0) << text;
    return wav;
  }

 private:
  TemporaryFolder folder_;
  std::string told_;
};

TEST_F(Log, OneProcessorTellsTheSameAsAll) {
  const std::string all = text_of(record("all.osc"));
  // By the names that PoCL 3 and its successors know.
  const std::string one = text_of(
      record("one.osc", 1, {{"POCL_MAX_PTHREAD_COUNT", "1"}, {"POCL_CPU_MAX_CU_COUNT", "1"}}));
  EXPECT_THAT(told(), testing::HasSubstr("(CPU, 1 compute units"));
  EXPECT_GT(all.size(), 1000U);
  EXPECT_EQ(one, all);
  EXPECT_NE(all, text_of(record("other.osc", 2))) << "another seed, another log";
}

TEST_F(Log, ReplayedTwiceGivesTheSameBitsAndOpensInScsynth) {
  const std::string log = record("replayed.osc");
  const std::string first = render(log, "first.wav");
  EXPECT_GT(peak(read_recording(first).channels.at(0)), 0.001F) << "something is heard";
  EXPECT_EQ(text_of(first), text_of(render(log, "second.wav")));
  const double last = protocol::read_log(log).back().seconds;
  EXPECT_NEAR(last, 3.0, 1.0) << "seconds since the start";
  if (!std::filesystem::exists("/usr/bin/scsynth")) GTEST_SKIP() << "there is no scsynth";
  const std::string wav = file("score.wav");
  ChildProcess scsynth(
      {"/usr/bin/scsynth", "-V", "-1", "-o", "1", "-N", log, "_", wav, "48000", "WAV", "float"});
  EXPECT_EQ(scsynth.wait_for_end(), 0) << scsynth.output();
  // It knows none of our commands, but renders until the last one's time.
  const Recording recording = read_recording(wav);
  ASSERT_EQ(recording.channels.size(), 1U);
  EXPECT_NEAR(static_cast<double>(recording.channels[0].size()) / 48000.0, last, 0.01);
}

}  // namespace
}  // namespace splash::tests
