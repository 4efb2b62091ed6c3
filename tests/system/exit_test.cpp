// SPDX-License-Identifier: MIT
// How the programs end when something is wrong: the code for scripts, the words for people. What
// the synth alone does is in tests/synth-server/live.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>

#include "protocol/event_log.hpp"
#include "protocol/udp_socket.hpp"
#include "tests/support/programs.hpp"
#include "tests/support/small_scene.hpp"
#include "tests/support/temporary_folder.hpp"
#include "tests/support/text_of.hpp"

namespace splash::tests {
namespace {

using testing::AllOf;
using testing::HasSubstr;

TEST(Exit, UnknownSceneKeyIsNamedWithItsPlace) {
  const SmallScene scene("{kind: script, repaet: true, keyframes: [{time: 0.0}]}");
  const auto [code, text] = simulate(scene.path(), 0.1);
  EXPECT_EQ(code, 78);
  EXPECT_THAT(text, AllOf(testing::ContainsRegex(scene.path() + ":[0-9]+:28: "),
                          HasSubstr("repaet"), HasSubstr("repeat")));
}

TEST(Exit, ARecordingThatMovesNothingIsAMistake) {
  const SmallScene scene(tracked());
  const auto [code, text] = simulate(scene.path(), 0.1, {"--tracker", "/nope.trc"});
  EXPECT_EQ(code, 64);
  EXPECT_THAT(text, HasSubstr("--tracker /nope.trc moves nothing: no body of the scene"));
}

// Minutes of silence would look like a hang.
TEST(Exit, SaysWhatTakesLongBeforeItBegins) {
  const SmallScene small("{kind: fixed}");
  std::string text = text_of(small.path());
  text.replace(text.find("1400"), 4, "400000");
  text.replace(text.find("    motion"), std::string::npos, "    rest: {position: [0, 0, 0.4]}\n");
  std::ofstream(small.path()) << text;
  ChildProcess simulator(
      command("sim-server", {"--scene", small.path(), "--listen", "127.0.0.1:0"}));
  EXPECT_TRUE(simulator.wait_for_text(" s to go (fewer fluid.particles")) << simulator.output();
}

TEST(Exit, MissingFilesAreNamed) {
  const auto scene = run_program("sim-server", {"--scene", "/nowhere/scene.yaml"});
  EXPECT_EQ(scene.code, 66);
  EXPECT_THAT(scene.text, HasSubstr("/nowhere/scene.yaml"));
  const auto rig = run_program("synth-server", {"--rig", "/nowhere/rig.yaml"});
  EXPECT_EQ(rig.code, 66);
  EXPECT_THAT(rig.text, HasSubstr("/nowhere/rig.yaml"));
  EXPECT_THAT(run_program("synth-server", {"--rig", "nowhere"}).text,
              HasSubstr("no such file in " + std::filesystem::current_path().string()))
      << "which folder was meant";
  const auto log =
      run_program("synth-server", {"--rig", rig_path("stereo.yaml"), "--replay", "/nowhere/a.osc",
                                   "--render", temporary_path("a.wav")});
  EXPECT_EQ(log.code, 66);
  EXPECT_THAT(log.text, HasSubstr("/nowhere/a.osc"));
}

TEST(Exit, MissingRecordingsAreNamed) {
  const SmallScene csv("{kind: csv, file: nowhere.csv}");
  const auto [code, text] = simulate(csv.path(), 0.1);
  EXPECT_EQ(code, 78) << "the scene names it";
  EXPECT_THAT(text, HasSubstr("nowhere.csv"));
}

TEST(Exit, TakenPortIsNamed) {
  const SmallScene scene(plunging());
  const protocol::UdpSocket taken({INADDR_LOOPBACK, 0});
  const std::string endpoint = protocol::to_string(taken.local());
  const auto simulator = simulate(scene.path(), 0.1, {"--listen", endpoint});
  EXPECT_EQ(simulator.code, 69);
  EXPECT_THAT(simulator.text, AllOf(HasSubstr(std::to_string(taken.local().port)),
                                    testing::Not(HasSubstr("compiling"))));
  const auto synth = run_program(
      "synth-server", {"--rig", rig_path("stereo.yaml"), "--device", "null", "--listen", endpoint});
  EXPECT_EQ(synth.code, 69);
  EXPECT_THAT(synth.text, HasSubstr(std::to_string(taken.local().port)));
}

TEST(Exit, WrongOptionsAreUsage) {
  for (const char* name : {"sim-server", "synth-server"}) {
    EXPECT_EQ(run_program(name, {}).code, 64) << name;
    EXPECT_EQ(run_program(name, {"--nonsense"}).code, 64) << name;
    const auto [code, text] = run_program(name, {"--listen", "nohost.invalid:1", "--scene", "x"});
    EXPECT_EQ(code, 64) << name;
    EXPECT_EQ(run_program(name, {"--duration", "soon"}).code, 64) << name;
    EXPECT_EQ(run_program(name, {"--duration", "nan"}).code, 64) << name;
    EXPECT_EQ(run_program(name, {"--help"}).code, 0) << name;
    EXPECT_EQ(run_program(name, {"--version"}).code, 0) << name;
  }
}

TEST(Exit, MistypedOptionsGetTheNearestName) {
  const auto simulator = run_program("sim-server", {"--scne", "x"});
  EXPECT_EQ(simulator.code, 64);
  EXPECT_THAT(simulator.text, HasSubstr("no option --scne; did you mean --scene?"));
  const auto synth = run_program("synth-server", {"--recod-audio=x"});
  EXPECT_EQ(synth.code, 64);
  EXPECT_THAT(synth.text, HasSubstr("no option --recod-audio; did you mean --record-audio?"));
  EXPECT_THAT(run_program("synth-server", {"tiles36"}).text,
              HasSubstr("'tiles36' belongs to no option"));
}

TEST(Exit, HostsThatAreNoneAreNamedWithTheirOption) {
  const SmallScene scene(plunging());
  for (const char* option : {"--listen", "--target", "--allow"}) {
    const auto [code, text] = simulate(scene.path(), 0.1, {option, "nohost.invalid"});
    EXPECT_EQ(code, 64);
    EXPECT_THAT(text,
                HasSubstr(std::string(option) + " 'nohost.invalid': host 'nohost.invalid': "));
  }
  // 192.0.2.0/24 is nobody's (RFC 5737).
  const auto foreign = simulate(scene.path(), 0.1, {"--listen", "192.0.2.1:57300"});
  EXPECT_EQ(foreign.code, 69);
  EXPECT_THAT(foreign.text, HasSubstr("with an address of this host"));
}

TEST(Exit, FilesThatCannotBeWrittenAreNamed) {
  const SmallScene scene(plunging());
  const auto log = simulate(scene.path(), 0.1, {"--record", "/nowhere/a.osc"});
  EXPECT_EQ(log.code, 74);
  EXPECT_THAT(log.text, HasSubstr("/nowhere/a.osc"));
  const auto report = simulate(scene.path(), 0.1, {"--report", "/nowhere/a.json"});
  EXPECT_EQ(report.code, 74);
  EXPECT_THAT(report.text, HasSubstr("/nowhere/a.json"));
  EXPECT_THAT(report.text, HasSubstr("density   error mean")) << "its figures are not lost with it";
  for (const auto& text : {log.text, report.text}) {
    EXPECT_THAT(text, HasSubstr("No such file or directory; name a file in a folder that exists"));
  }
}

TEST(Exit, FullDiskIsSaid) {
  if (!std::filesystem::exists("/dev/full")) GTEST_SKIP() << "there is no /dev/full";
  const SmallScene scene(plunging());
  const auto [code, text] = simulate(scene.path(), 2.0, {"--record", "/dev/full"});
  EXPECT_EQ(code, 74) << text;
  EXPECT_THAT(text, HasSubstr("/dev/full"));
}

TEST(Exit, FullDiskEndsTheRecordingNotTheRun) {
  if (!std::filesystem::exists("/dev/full")) GTEST_SKIP() << "there is no /dev/full";
  const SmallScene scene(plunging());
  const auto simulator =
      run_program("sim-server", {"--scene", scene.path(), "--listen", "127.0.0.1:0", "--record",
                                 "/dev/full", "--duration", "1"});
  EXPECT_EQ(simulator.code, 74);
  EXPECT_THAT(simulator.text, AllOf(HasSubstr("/dev/full': No space left on device; free space"),
                                    HasSubstr("The run goes on without it")));
  const auto synth = run_program("synth-server",
                                 {"--rig", rig_path("stereo.yaml"), "--device", "null", "--listen",
                                  "127.0.0.1:0", "--record-audio", "/dev/full", "--duration", "2"});
  EXPECT_EQ(synth.code, 74);
  EXPECT_THAT(synth.text,
              AllOf(HasSubstr("/dev/full: cannot write: No space left on device; free space"),
                    HasSubstr("Playing goes on, the recording ends here")));
}

// The signal that the kernel sends then would end a program without a word.
TEST(Exit, AFileAsLongAsItMayBeIsAFullDisk) {
  const TemporaryFolder folder;
  const std::string path = folder / "limited.wav";
  Arguments shell{"/bin/sh", "-c", "ulimit -f 64; exec \"$0\" \"$@\""};
  for (const std::string& word :
       command("synth-server", {"--rig", rig_path("stereo.yaml"), "--device", "null", "--listen",
                                "127.0.0.1:0", "--record-audio", path, "--duration", "2"})) {
    shell.push_back(word);
  }
  ChildProcess synth(shell);
  EXPECT_EQ(synth.wait_for_end(), 74) << synth.output();
  EXPECT_THAT(synth.output(), AllOf(HasSubstr("the limit of file sizes is reached ('ulimit -f')"),
                                    HasSubstr("Playing goes on, the recording ends here")));
}

// Bytes on the disk for each second of it; the old file is not touched.
TEST(Exit, ALogOfMoreThanAWeekIsNotRendered) {
  const TemporaryFolder folder;
  const std::string log = folder / "old.osc";
  const std::string wav = folder.write("old.wav", "as it was");
  protocol::Bubble bubble;
  bubble.radius = 0.01F;
  protocol::LogWriter(log).append(4e9, {protocol::to_message(bubble)});
  const auto [code, text] = run_program(
      "synth-server", {"--rig", rig_path("stereo.yaml"), "--replay", log, "--render", wav});
  EXPECT_EQ(code, 65) << text;
  EXPECT_THAT(text, AllOf(HasSubstr(log), HasSubstr("4000000000 s"), HasSubstr("604800 s")));
  EXPECT_EQ(text_of(wav), "as it was");
}

TEST(Exit, DeviceThatIsNotThereIsUnavailable) {
  const SmallScene scene(plunging());
  const auto [code, text] = simulate(scene.path(), 0.1, {"--device", "99"});
  EXPECT_EQ(code, 69);
  EXPECT_THAT(text, testing::ContainsRegex("--device 99: there is no such OpenCL device; there "
                                           "(is only|are) 0: .*compute units"));
}

}  // namespace
}  // namespace splash::tests
