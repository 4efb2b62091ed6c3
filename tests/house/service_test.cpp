// SPDX-License-Identifier: MIT
// The units that ./splash service writes: with this tree's paths, and as systemd takes them.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>
#include <regex>

#include "tests/support/programs.hpp"
#include "tests/support/temporary_folder.hpp"
#include "tests/support/text_of.hpp"

namespace splash::house {
namespace {

namespace fs = std::filesystem;
using testing::HasSubstr;
using testing::Not;

/// A home of its own, and a cmake that builds nothing. Paths with characters that mean something to
/// the shell, to sed or to systemd.
class Service : public testing::Test {
 protected:
  Service() {
    write_program("tools/cmake", "");
    write_program("tools/dpkg-query",
                  "sed -n 's/^\\([a-z0-9+.-]*\\) *| .*/ii \\1/p' '" SPLASH_SOURCE_DIR "/splash'");
    write_program("a & 100% b/bin/sim-server",
                  "echo \"scene   $2\"; echo 'middle  0.915,0.5,0.25'");
    write_program("a & 100% b/bin/synth-server", "");
    write_program("a & 100% b/bin/view-server", "");
  }

  void write_program(const std::string& name, const std::string& body) const {
    fs::permissions(folder_.write(name, "#!/bin/sh\n" + body + '\n'), fs::perms::owner_all);
  }
  [[nodiscard]] fs::path build() const { return folder_ / "a & 100% b"; }
  [[nodiscard]] tests::Ended launch(const std::string& arguments) const {
    return tests::run_shell("XDG_CONFIG_HOME='" + folder_.path().string() + "' PATH='" +
                            (folder_ / "tools").string() + "':$PATH " + SPLASH_SOURCE_DIR +
                            "/splash service " + arguments + " --no-install --build-dir '" +
                            build().string() + "'");
  }
  [[nodiscard]] fs::path unit(const std::string& name) const {
    return folder_ / ("systemd/user/" + name + ".service");
  }

  tests::TemporaryFolder folder_;
};

TEST_F(Service, HasThisTreesPaths) {
  const tests::Ended result = launch("pool --rig tiles36");
  ASSERT_EQ(result.code, 0) << result.text;
  EXPECT_THAT(result.text, HasSubstr("systemctl --user enable --now splash-sim"));
  const std::string sim = tests::text_of(unit("splash-sim"));
  const std::string synth = tests::text_of(unit("splash-synth"));
  const std::string view = tests::text_of(unit("splash-view"));
  EXPECT_THAT(view, HasSubstr("/a & 100%% b/bin/view-server\" --listen 127.0.0.1:8080 "));
  const std::string configs = std::string(SPLASH_SOURCE_DIR) + "/configs/";
  EXPECT_THAT(sim, HasSubstr("/a & 100%% b/bin/sim-server\" --scene \"" + configs +
                             "scenes/pool.yaml\" --listen 127.0.0.1:57300 --allow 127.0.0.1 "
                             "--target 127.0.0.1:57310 --show 127.0.0.1:57301 --quiet\n"));
  EXPECT_THAT(
      synth, HasSubstr("/bin/synth-server\" --rig \"" + configs + "rigs/tiles36.yaml\" --sound \"" +
                       configs + "sounds/calibrated.yaml\" --middle=0.915,0.5,0.25 "));
  for (const std::string& text : {sim, synth, view}) {
    EXPECT_THAT(text, Not(testing::ContainsRegex("@[A-Z]+@")));
    EXPECT_THAT(text, HasSubstr("\nType=notify\n"));
    EXPECT_THAT(text, testing::ContainsRegex("\nWatchdogSec=[0-9]+\n"));
    EXPECT_THAT(text, HasSubstr("\nRestart=on-failure\n"));
    EXPECT_THAT(text, HasSubstr("\nNoNewPrivileges=yes\n"));
    EXPECT_THAT(text, testing::ContainsRegex("\nRestrictAddressFamilies=.*AF_INET .*\n"));
    EXPECT_THAT(text, testing::ContainsRegex("\nMemoryMax=[0-9]+%\n"));
  }
}

TEST_F(Service, KnowsWhereTheOtherProgramIs) {
  const tests::Ended result = launch("pool --hosts 192.168.0.10,192.168.0.20");
  ASSERT_EQ(result.code, 0) << result.text;
  EXPECT_THAT(result.text, testing::ContainsRegex("splash-synth .*# on 192.168.0.20\n"));
  const std::string sim = tests::text_of(unit("splash-sim"));
  EXPECT_THAT(sim, HasSubstr(" --listen 0.0.0.0:57300 --allow 192.168.0.20 "
                             "--target 192.168.0.20:57310 --show 0.0.0.0:57301 --quiet\n"));
  EXPECT_THAT(sim, Not(HasSubstr("splash-synth"))) << "this host has none to start";
  EXPECT_THAT(tests::text_of(unit("splash-synth")),
              HasSubstr(" --listen 0.0.0.0:57310 --allow 192.168.0.10 "
                        "--forces 192.168.0.10:57300 --show 0.0.0.0:57311\n"));
  EXPECT_THAT(tests::text_of(unit("splash-view")),
              HasSubstr(" --sim 127.0.0.1:57300 --synth 192.168.0.20:57310 "
                        "--sim-show 127.0.0.1:57301 --synth-show 192.168.0.20:57311\n"));
  for (const char* wrong : {"--hosts 192.168.0.10", "--hosts a,b", "pool", "-- --allow 1.2.3.4"}) {
    EXPECT_EQ(launch(std::string("pool ") + wrong).code, 64) << wrong;
  }
}

TEST_F(Service, IsWhatSystemdTakes) {
  if (tests::run_shell("systemd-analyze --version").code != 0) {
    GTEST_SKIP() << "there is no systemd-analyze";
  }
  ASSERT_EQ(launch("basin").code, 0);
  const std::string verify =
      "XDG_RUNTIME_DIR='" + build().string() + "' systemd-analyze verify --user --man=no '";
  const tests::Ended right = tests::run_shell(verify + unit("splash-sim").string() + "' '" +
                                              unit("splash-synth").string() + "' '" +
                                              unit("splash-view").string() + "' 2>&1");
  EXPECT_THAT(right.text, Not(HasSubstr("splash-")));
  std::ofstream(unit("splash-sim"), std::ios::app) << "[Service]\nWatchdogSecs=3\n";
  EXPECT_THAT(tests::run_shell(verify + unit("splash-sim").string() + "' 2>&1").text,
              HasSubstr("WatchdogSecs"))
      << "it does look";
}

TEST_F(Service, FindsOnesOwnScenesAndRigsByName) {
  const fs::path scene =
      folder_.write("splash/scenes/pond.yaml", "name: pond\ndescription: frogs\n");
  const fs::path rig = folder_.write("splash/rigs/stereo.yaml", "name: mine\n");
  ASSERT_EQ(launch("pond --rig stereo").code, 0);
  EXPECT_THAT(tests::text_of(unit("splash-sim")), HasSubstr(scene.string()));
  EXPECT_THAT(tests::text_of(unit("splash-synth")), HasSubstr(rig.string()));
  EXPECT_THAT(launch("--help").text, testing::ContainsRegex("\n  pond +frogs\n"));
}

TEST_F(Service, KnowsItsScenesAndRigs) {
  EXPECT_EQ(launch("puddle").code, 66);
  EXPECT_EQ(launch("pool --rig trumpet").code, 66);
  EXPECT_EQ(launch("pool --sound brass").code, 66);
}

/// The numbers in docs/running.md, the units and the header are the same.
TEST(ExitCodes, AreToldAsTheyAre) {
  const fs::path root = SPLASH_SOURCE_DIR;
  const std::string header = tests::text_of(root / "program" / "failure.hpp");
  const std::string readme = tests::text_of(root / "docs/running.md");
  static const std::regex kCode(R"(kExit\w+ = (\d+),)");
  int codes = 0;
  for (std::sregex_iterator it(header.begin(), header.end(), kCode), end; it != end; ++it) {
    EXPECT_THAT(readme, HasSubstr("\n| " + (*it)[1].str() + " | ")) << (*it)[0];
    ++codes;
  }
  EXPECT_GE(codes, 8);
  static const std::regex kRow(R"(\n\| (\d+) \| )");
  for (std::sregex_iterator it(readme.begin(), readme.end(), kRow), end; it != end; ++it) {
    if ((*it)[1] == "130") continue;  // the shell's, of a second Ctrl-C
    EXPECT_THAT(header, HasSubstr(" = " + (*it)[1].str() + ",")) << (*it)[0];
  }
}

}  // namespace
}  // namespace splash::house
