// SPDX-License-Identifier: MIT
// What the launcher does before anything is built, on a machine whose dpkg and apt are played by
// scripts.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <filesystem>

#include "tests/support/programs.hpp"
#include "tests/support/temporary_folder.hpp"
#include "tests/support/text_of.hpp"

namespace splash::house {
namespace {

namespace fs = std::filesystem;
using testing::AllOf;
using testing::HasSubstr;
using testing::IsEmpty;
using testing::Not;

class Launcher : public testing::Test {
 protected:
  Launcher() {
    // Nothing is installed but what a test says; apt-get notes how it was called and gives up.
    write_program("dpkg-query", "cat '" + (folder_ / "installed").string() + "' 2>/dev/null");
    write_program("apt-get", "echo \"$@\" >>'" + (folder_ / "apt").string() + "'; exit 100");
    write_program("sudo", "\"$@\"");
  }

  void write_program(const std::string& name, const std::string& body) const {
    fs::permissions(folder_.write(name, "#!/bin/sh\n" + body + '\n'), fs::perms::owner_all);
  }

  void pretend_installed(const std::string& dpkg_lines) const {
    folder_.write("installed", dpkg_lines);
  }

  tests::Ended launch(const std::string& arguments) const {
    return tests::run_shell("PATH='" + folder_.path().string() + "':$PATH " + SPLASH_SOURCE_DIR +
                            "/splash " + arguments + " --build-dir '" + build().string() + "'");
  }
  fs::path build() const { return folder_ / "build"; }

  std::string apt_calls() const { return tests::text_of(folder_ / "apt"); }
  fs::path synth_call() const { return folder_ / "synth-call"; }

 private:
  tests::TemporaryFolder folder_;
};

TEST_F(Launcher, NamesWhatIsMissingAndWhyAndStopsWhenTold) {
  const tests::Ended result = launch("build --no-install");
  EXPECT_EQ(result.code, 69);
  EXPECT_THAT(result.text,
              AllOf(HasSubstr("liblo-dev             sim-server sends OSC with it"),
                    HasSubstr("--no-install was given"),
                    HasSubstr("apt-get install --no-install-recommends cmake ninja-build")));
  EXPECT_THAT(result.text, Not(HasSubstr("clang-tidy")));
  EXPECT_THAT(apt_calls(), IsEmpty());
}

TEST_F(Launcher, TestsNeedMorePackages) {
  EXPECT_THAT(
      launch("test --no-install").text,
      AllOf(HasSubstr("libgtest-dev"), HasSubstr("liblo-dev"), Not(HasSubstr("clang-tidy"))));
  EXPECT_THAT(launch("test --analysis --no-install").text,
              AllOf(HasSubstr("libgtest-dev"), HasSubstr("clang-tidy"), HasSubstr("cppcheck")));
}

TEST_F(Launcher, InstallsOnlyWhatIsMissing) {
  pretend_installed("ii cmake\nii liblo-dev\nrc ninja-build\nhi pkg-config\n");
  const tests::Ended result = launch("build");
  EXPECT_EQ(result.code, 69);  // apt-get gave up
  EXPECT_THAT(result.text, HasSubstr("apt could not install the packages"));
  const std::string calls = apt_calls();
  EXPECT_THAT(calls, AllOf(HasSubstr("update"), HasSubstr("install -y"), HasSubstr("ninja-build"),
                           HasSubstr("pocl-opencl-icd")));
  EXPECT_THAT(calls, AllOf(Not(HasSubstr("cmake")), Not(HasSubstr("liblo-dev")),
                           Not(HasSubstr("pkg-config"))));
}

TEST_F(Launcher, TellsWhatTestsSkippedAndWhatSanitizersReported) {
  write_program("apt-get", "exit 0");
  write_program("cmake", "exit 0");
  write_program("ctest", R"(mkdir -p "$2/Testing/Temporary"
    cat >"$2/Testing/Temporary/LastTest.log" <<'LOG'
1/2 Test: room/Some.Case
a_test.cpp:7: Skipped
no such thing here

2/2 Test: other_test
Skipped: it replaces malloc
LOG
    reports=${ASAN_OPTIONS##*log_path=}
    [ ! -e "$2/faulty" ] || echo "SUMMARY: ThreadSanitizer: a race" >"$reports.program.1"
    echo "WARNING: ASan is ignoring a request" >"$reports.program.2"
    echo "100% tests passed, 0 tests failed out of 2")");
  const tests::Ended sound = launch("test --preset tsan");
  EXPECT_EQ(sound.code, 0) << sound.text;
  EXPECT_THAT(sound.text, AllOf(HasSubstr("skipped: room/Some.Case: no such thing here\n"),
                                HasSubstr("skipped: other_test: it replaces malloc\n"),
                                HasSubstr("\n0 reports of sanitizers\n4 tests run, 0 failed")));
  write_program("build/faulty", "");
  const tests::Ended faulty = launch("test --preset tsan");
  EXPECT_EQ(faulty.code, 1);
  EXPECT_THAT(faulty.text,
              AllOf(HasSubstr("/report.program.1:\nSUMMARY: ThreadSanitizer: a race\n"),
                    HasSubstr("\n1 reports of sanitizers\n")));
  fs::remove(build() / "faulty");
  EXPECT_THAT(launch("test").text, Not(HasSubstr("of sanitizers")));
}

TEST_F(Launcher, RunsUnitsThenProgramsThenWhatIsSlow) {
  write_program("apt-get", "exit 0");
  write_program("cmake", "echo \"$@\" | grep -o -e '-DSPLASH_SLOW=.*' >>'" + synth_call().string() +
                             "'; exit 0");
  write_program(
      "ctest",
      "shift 6; echo \"$@\"; echo ' 1/2 Test #7: room/Some.Case ....   Passed   20.01 sec'; "
      "echo ' 2/2 Test #8: room/Other.Case ...   Passed   19.99 sec'");
  const std::string quick =
      "--label-exclude ^(live|slow|long)$\n 1/2 Test #7: room/Some.Case ....   Passed   20.01 sec\n"
      " 2/2 Test #8: room/Other.Case ...   Passed   19.99 sec\n--label-regex ^live$\n";
  const std::string unmarked =
      "\ntook over 20 s, mark it SLOW unless kernels were compiled: room/Some.Case\n";
  const std::string all = launch("test").text;
  EXPECT_THAT(all, AllOf(HasSubstr(quick), HasSubstr(unmarked), Not(HasSubstr("Other.Case\n"))));
  EXPECT_THAT(all, Not(HasSubstr("--label-regex ^(slow")));
  EXPECT_EQ(tests::text_of(synth_call()), "-DSPLASH_SLOW=\n");
  EXPECT_THAT(
      launch("test --slow").text,
      AllOf(HasSubstr(quick), HasSubstr("\n--label-regex ^(slow)$\n"), Not(HasSubstr(unmarked))));
  EXPECT_THAT(launch("test --long").text, HasSubstr("\n--label-regex ^(slow|long)$\n"));
  EXPECT_THAT(launch("test --filter Some").text,
              AllOf(HasSubstr("--tests-regex Some\n"), Not(HasSubstr("--label"))));
  EXPECT_EQ(tests::text_of(synth_call()),
            "-DSPLASH_SLOW=\n-DSPLASH_SLOW=1\n-DSPLASH_SLOW=1\n-DSPLASH_SLOW=1\n");
}

TEST_F(Launcher, AnswersWrongUseWithWhatIsRight) {
  const tests::Ended command = launch("dmeo");
  EXPECT_EQ(command.code, 64);
  EXPECT_THAT(command.text, AllOf(HasSubstr("dmeo"),
                                  HasSubstr("there are demo, run, play, listen, service, test")));
  EXPECT_EQ(launch("demo --no-instal").code, 64);
  EXPECT_EQ(tests::run_shell(std::string(SPLASH_SOURCE_DIR) + "/splash test --filter").code, 64);
  EXPECT_EQ(launch("run").code, 64);
  EXPECT_EQ(launch("demo --duration 4").code, 64) << "the demo has its own";
}

TEST_F(Launcher, ChecksNamesBeforeAnythingIsInstalledOrBuilt) {
  const auto suggests = [this](const std::string& arguments, int code, const std::string& name) {
    const tests::Ended result = launch(arguments);
    EXPECT_EQ(result.code, code) << arguments;
    EXPECT_THAT(result.text, HasSubstr("did you mean " + name + "?")) << arguments;
  };
  suggests("dmeo", 64, "demo");
  suggests("run poool", 66, "pool");
  suggests("run pool --rig tile36", 66, "tiles36");
  suggests("demo --rig stero", 66, "stereo");
  suggests("service baisn", 66, "basin");
  suggests("bench fauts", 66, "faults");
  EXPECT_THAT(launch("run aquarium").text,
              AllOf(HasSubstr("there are: basin beach"), Not(HasSubstr("did you mean"))));
  const tests::Ended benches = launch("bench");
  EXPECT_EQ(benches.code, 0);
  EXPECT_THAT(benches.text, HasSubstr(" faults "));
  EXPECT_THAT(apt_calls(), IsEmpty());
}

TEST_F(Launcher, TellsTheSynthWhereTheScenesMiddleLies) {
  for (const char* name : {"apt-get", "cmake"}) write_program(name, "exit 0");
  write_program("build/bin/sim-server",
                "case \"$*\" in *--check*) echo 'middle  0.915,0.5,0.25';; esac");
  write_program("build/bin/synth-server",
                "echo \"$@\" >'" + synth_call().string() + "'; echo 'listening: here'; sleep 60");
  const tests::Ended right = launch("run pool --out '" + (build() / "out").string() + "'");
  EXPECT_EQ(right.code, 0) << right.text;
  EXPECT_THAT(tests::text_of(synth_call()), HasSubstr("/stereo.yaml --sound "));
  EXPECT_THAT(tests::text_of(synth_call()), HasSubstr("/calibrated.yaml --listen 127.0.0.1:573"));
  EXPECT_THAT(tests::text_of(synth_call()), HasSubstr(" --middle=0.915,0.5,0.25\n"));

  fs::remove(synth_call());
  write_program("build/bin/sim-server", "echo 'pool.yaml:3:1: wrong' >&2; exit 78");
  const tests::Ended wrong = launch("run pool --out '" + (build() / "out").string() + "'");
  EXPECT_EQ(wrong.code, 78);
  EXPECT_THAT(wrong.text, HasSubstr("pool.yaml:3:1: wrong"));
  EXPECT_FALSE(fs::exists(synth_call())) << "a wrong scene is told before anything starts";
}

TEST_F(Launcher, HelpAndVersionNeedNothing) {
  EXPECT_EQ(launch("--help").code, 0);
  EXPECT_THAT(launch("--version").text, HasSubstr("splash 0."));
  EXPECT_THAT(apt_calls(), IsEmpty());
}

TEST_F(Launcher, HelpOnACommandListsWhatThereIs) {
  for (const char* line : {"run --help", "help run", "run pool -h"}) {
    const tests::Ended help = launch(line);
    EXPECT_EQ(help.code, 0) << line;
    EXPECT_THAT(help.text,
                AllOf(HasSubstr("./splash run SCENE"),
                      testing::ContainsRegex("\n  pool +two feet step in place in 20 cm of water"),
                      testing::ContainsRegex("\n  tiles36 +floor of 6 x 6 tiles"),
                      testing::ContainsRegex("\n  --duration S +end after"),
                      HasSubstr("Behind -- stands whatever else sim-server takes")))
        << line;
  }
  EXPECT_THAT(launch("demo --help").text,
              AllOf(HasSubstr("  stereo "), HasSubstr("--out DIR"), Not(HasSubstr("  pool "))));
  EXPECT_THAT(launch("bench --help").text,
              testing::ContainsRegex("\n  validation +Runs the validation cases"));
  EXPECT_THAT(launch("help test").text, HasSubstr("--filter REGEX"));
  for (const char* name :
       {"demo", "run", "service", "test", "bench", "build", "bundle", "clean", "help"}) {
    EXPECT_THAT(launch(std::string(name) + " --help").text, HasSubstr(name)) << name;
    EXPECT_EQ(launch(std::string("help ") + name).code, 0) << name;
  }
  EXPECT_THAT(apt_calls(), IsEmpty());
}

TEST_F(Launcher, WordsThatAreNoCommandsGetTheNearestOne) {
  EXPECT_THAT(launch("help rnu").text, HasSubstr("did you mean run?"));
  EXPECT_THAT(launch("list").text, AllOf(HasSubstr("./splash help run lists the scenes"),
                                         Not(HasSubstr("did you mean test"))));
  const tests::Ended option = launch("run pool --durtion 5");
  EXPECT_EQ(option.code, 64);
  EXPECT_THAT(option.text, HasSubstr("did you mean --duration?"));
  const tests::Ended foreign = launch("test --rig stereo");
  EXPECT_EQ(foreign.code, 64);
  EXPECT_THAT(foreign.text, HasSubstr("--rig is for demo, run, play, service"));
  EXPECT_THAT(launch("test --out x").text, HasSubstr("--out is for demo, run, play, bundle"));
}

}  // namespace
}  // namespace splash::house
