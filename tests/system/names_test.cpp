// SPDX-License-Identifier: MIT
// The programs take scenes and rigs by name, where they are built and where they are installed, and
// the launcher tells the synth where the scene's middle lies.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <filesystem>
#include <regex>

#include "tests/support/programs.hpp"
#include "tests/support/recording.hpp"
#include "tests/support/temporary_folder.hpp"

namespace splash::tests {
namespace {

namespace fs = std::filesystem;
using testing::AllOf;
using testing::HasSubstr;

/// No scenes and rigs of one's own.
const ChildProcess::Environment kNobody = {{"XDG_CONFIG_HOME", "/nonexistent"}};

Ended run_anywhere(const Arguments& words) {
  return run_command(words, 60.0, kNobody);
}

std::string middle_of(const std::string& scene) {
  const auto [code, text] = run_program("sim-server", {"--scene", scene, "--check"}, 60.0, kNobody);
  EXPECT_EQ(code, 0) << text;
  std::smatch found;
  EXPECT_TRUE(std::regex_search(text, found, std::regex("\nmiddle  (\\S+)\n"))) << text;
  return found[1].str();
}

double level_db(const std::vector<float>& signal) {
  double power = 0.0;
  for (const float sample : signal) {
    power += static_cast<double>(sample) * static_cast<double>(sample);
  }
  return 10.0 * std::log10(power / static_cast<double>(signal.size()));
}

TEST(Names, AreFoundWhereTheProgramsAreBuilt) {
  const auto scene = run_program("sim-server", {"--scene", "pool", "--check"}, 60.0, kNobody);
  EXPECT_EQ(scene.code, 0);
  EXPECT_THAT(scene.text, AllOf(HasSubstr("scene   pool: two feet step in place"),
                                HasSubstr("tank    from (0, 0, 0) to (1.83, 1.83, 0.5) m")));
  const auto rig = run_program(
      "synth-server",
      {"--rig", "tiles36", "--device", "null", "--listen", "127.0.0.1:0", "--duration", "0.1"},
      60.0, kNobody);
  EXPECT_EQ(rig.code, 0);
  EXPECT_THAT(rig.text, HasSubstr("rig: tiles36, 36 channels"));
}

TEST(Names, ThatAreWrongListWhatThereIs) {
  const auto scene = run_program("sim-server", {"--scene", "poool"}, 60.0, kNobody);
  EXPECT_EQ(scene.code, 66);
  EXPECT_THAT(scene.text,
              AllOf(HasSubstr("--scene poool: there is no such file in "),
                    HasSubstr("did you mean pool?"), HasSubstr("There are: basin beach boat")));
  const auto rig = run_program("synth-server", {"--rig", "tile36"}, 60.0, kNobody);
  EXPECT_EQ(rig.code, 66);
  EXPECT_THAT(rig.text, HasSubstr("did you mean tiles36?"));
}

// What is installed may be moved to another place, and the source tree may go.
TEST(Names, AreFoundWhereTheProgramsAreInstalled) {
  const TemporaryFolder folder;
  const fs::path first = folder / "prefix";
  const fs::path prefix = folder / "moved";
  const auto installed = run_anywhere(
      {"cmake", "--install", std::string(SPLASH_BINARY_DIR) + "/..", "--prefix", first.string()});
  ASSERT_EQ(installed.code, 0) << installed.text;
  fs::rename(first, prefix);
  const std::string bin = (prefix / "bin").string();
  const auto scene = run_anywhere({bin + "/sim-server", "--scene", "basin", "--check"});
  EXPECT_EQ(scene.code, 0) << scene.text;
  fs::rename(prefix / "share" / "splash" / "configs" / "rigs" / "stereo.yaml",
             prefix / "share" / "splash" / "configs" / "rigs" / "phones.yaml");
  const auto rig = run_anywhere({bin + "/synth-server", "--rig", "phones", "--device", "null",
                                 "--listen", "127.0.0.1:0", "--duration", "0.1"});
  EXPECT_EQ(rig.code, 0) << rig.text;
  EXPECT_EQ(run_anywhere({bin + "/synth-server", "--rig", "stereo"}).code, 66)
      << "the source tree's are another's";
}

TEST(Names, LauncherAndSimulatorKnowTheSameOptions) {
  const auto help = run_anywhere({std::string(SPLASH_SOURCE_DIR) + "/splash", "run", "--help"});
  ASSERT_EQ(help.code, 0);
  const std::string simulator = run_program("sim-server", {"--help"}).text;
  static const std::regex kOption(R"(\n  (--[a-z-]+) [A-Z:.a-z]+ )");
  int found = 0;
  for (std::sregex_iterator it(help.text.begin(), help.text.end(), kOption), end; it != end; ++it) {
    const std::string option = (*it)[1].str();
    if (option == "--rig" || option == "--sound" || option == "--out") continue;
    if (option == "--preset" || option == "--build-dir") continue;
    EXPECT_THAT(simulator, HasSubstr("  " + option + " "));
    ++found;
  }
  EXPECT_GE(found, 8);
}

// On headphones both ears hear the feet, which step to both sides of the tank's middle.
TEST(Middle, APoolIsHeardOnBothSides) {
  const TemporaryFolder folder;
  const std::string wav = folder / "pool-stereo.wav";
  const auto difference = [&](const std::string& middle) {
    const auto [code, text] = run_program(
        "synth-server", {"--rig", "stereo", "--middle=" + middle, "--replay",
                         std::string(SPLASH_SOURCE_DIR) + "/tests/data/pool.osc", "--render", wav});
    EXPECT_EQ(code, 0) << text;
    const Recording recording = read_recording(wav);
    return level_db(recording.channels.at(0)) - level_db(recording.channels.at(1));
  };
  EXPECT_EQ(middle_of("pool"), "0.915,0.915,0.25");
  EXPECT_LT(std::abs(difference(middle_of("pool"))), 6.0);
  EXPECT_LT(difference("0,0,0"), -12.0) << "what a rig around x = 0 makes of it";
}

}  // namespace
}  // namespace splash::tests
