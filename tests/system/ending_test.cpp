// SPDX-License-Identifier: MIT
// SIGINT and /quit end both programs cleanly: exit status 0, files whole, closing words. What
// SIGTERM does is seen in launcher_live_test.cpp.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <csignal>
#include <filesystem>
#include <fstream>
#include <nlohmann/json.hpp>

#include "protocol/event_log.hpp"
#include "tests/support/programs.hpp"
#include "tests/support/recording.hpp"
#include "tests/support/small_scene.hpp"
#include "tests/support/temporary_folder.hpp"
#include "tests/support/text_of.hpp"
#include "tests/support/waiting.hpp"

namespace splash::tests {
namespace {

class Ending : public testing::TestWithParam<int> {
 protected:
  /// 0 stands for /quit.
  static void end(Daemon& daemon) {
    if (GetParam() == 0) {
      EXPECT_EQ(daemon.ask({"/quit", {}}, "/done").address, "/done");
    } else {
      daemon.process().signal(GetParam());
    }
    EXPECT_EQ(daemon.process().wait_for_end(), 0) << daemon.process().output();
  }
};

TEST_P(Ending, OfTheSimulatorClosesLogAndReport) {
  const SmallScene scene(plunging());
  const TemporaryFolder folder;
  const std::string log = folder / "ending.osc";
  const std::string report = folder / "ending.json";
  Simulator simulator({"--scene", scene.path(), "--record", log, "--report", report});
  ASSERT_TRUE(eventually([&] { return text_of(log).size() > 1000; }, 60.0));
  end(simulator);
  EXPECT_THAT(simulator.process().output(),
              testing::AllOf(testing::HasSubstr("events "), testing::HasSubstr("pacing ")));
  EXPECT_TRUE(std::filesystem::exists(report));
  const auto entries = protocol::read_log(log);
  ASSERT_FALSE(entries.empty());
  EXPECT_EQ(entries.back().messages.size(), 1U);
  EXPECT_TRUE(protocol::to_frame(entries.back().messages.at(0))) << "a /frame closes the log";
  const double simulated = nlohmann::json::parse(std::ifstream(report))["simulated_seconds"];
  EXPECT_NEAR(entries.back().seconds, simulated, 0.1) << "to the end";
}

TEST_P(Ending, OfTheSynthClosesItsRecording) {
  const TemporaryFolder folder;
  const std::string wav = folder / "ending.wav";
  Synth synth({"--rig", rig_path("stereo.yaml"), "--device", "null", "--record-audio", wav});
  end(synth);
  EXPECT_THAT(synth.process().output(), testing::ContainsRegex("ran [0-9.]+ s: played 0 impacts"));
  EXPECT_EQ(read_recording(wav).channels.size(), 2U);
}

std::string way(const testing::TestParamInfo<int>& info) {
  return info.param == SIGINT ? "BySigint" : "ByQuit";
}

INSTANTIATE_TEST_SUITE_P(Ways, Ending, testing::Values(SIGINT, 0), way);

}  // namespace
}  // namespace splash::tests
