// SPDX-License-Identifier: MIT
// Signals as daemons take them: a second one ends at once, SIGHUP begins files anew that were moved
// away, a terminal that closes ends its programs cleanly, a reader that goes away ends nothing.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <csignal>
#include <filesystem>
#include <fstream>

#include "protocol/event_log.hpp"
#include "tests/support/programs.hpp"
#include "tests/support/recording.hpp"
#include "tests/support/small_scene.hpp"
#include "tests/support/temporary_folder.hpp"
#include "tests/support/text_of.hpp"
#include "tests/support/waiting.hpp"

namespace splash::tests {
namespace {

namespace fs = std::filesystem;
using testing::HasSubstr;

constexpr double kTimeout = 60.0;  ///< [s]

class Signals : public testing::Test {
 protected:
  [[nodiscard]] std::string file(const std::string& name) const { return folder_ / name; }
  Arguments synth(const Arguments& further = {}) const {
    Arguments all{"--rig", rig_path("stereo.yaml"), "--device", "null"};
    all.insert(all.end(), further.begin(), further.end());
    return all;
  }
  Arguments simulator(const Arguments& further = {}) const {
    Arguments all{"--scene", scene_.path()};
    all.insert(all.end(), further.begin(), further.end());
    return all;
  }

 private:
  SmallScene scene_{plunging()};
  TemporaryFolder folder_;
};

/// Both signals wait while the process stands still: the second finds the first one seen.
void send_two(Daemon& daemon) {
  daemon.process().signal(SIGSTOP);
  daemon.process().signal(SIGINT);
  daemon.process().signal(SIGTERM);
  daemon.process().signal(SIGCONT);
}

TEST_F(Signals, TheSecondEndsAtOnce) {
#ifdef __SANITIZE_THREAD__
  GTEST_SKIP()
      << "ThreadSanitizer keeps signals back until later, and then drops the second, whose "
         "handler the first one has taken away";
#endif
  Simulator simulator_daemon(simulator());
  send_two(simulator_daemon);
  EXPECT_GE(simulator_daemon.process().wait_for_end(), 128);
  Synth synth_daemon(synth());
  send_two(synth_daemon);
  EXPECT_EQ(synth_daemon.process().wait_for_end(), 128 + SIGTERM);
}

TEST_F(Signals, HangupBeginsTheLogAnewThatWasMovedAway) {
  const std::string log = file("a.osc");
  Simulator daemon(simulator({"--record", log}));
  const auto has_bundles = [&] { return text_of(log).size() > 200; };
  ASSERT_TRUE(eventually(has_bundles, kTimeout));
  sleep(1.5);  // longer than from one plunge to the next
  daemon.process().signal(SIGHUP);
  ASSERT_TRUE(daemon.process().wait_for_text("a.osc is still there: move it away", kTimeout));
  fs::rename(log, file("first.osc"));
  daemon.process().signal(SIGHUP);
  ASSERT_TRUE(daemon.process().wait_for_text("began " + log + " anew", kTimeout));
  ASSERT_TRUE(eventually(has_bundles, kTimeout));
  EXPECT_EQ(daemon.end(), 0) << daemon.process().output();
  const auto first = protocol::read_log(file("first.osc"));
  const auto second = protocol::read_log(log);
  ASSERT_FALSE(first.empty());
  ASSERT_GT(second.size(), 1U);
  EXPECT_LT(second.front().seconds, first.back().seconds) << "its time begins anew";
  EXPECT_TRUE(protocol::to_frame(first.back().messages.at(0))) << "a /frame closes the first";
}

TEST_F(Signals, HangupBeginsTheRecordingAnewThatWasMovedAway) {
  const std::string wav = file("a.wav");
  Synth daemon(synth({"--record-audio", wav}));
  sleep(0.5);
  daemon.process().signal(SIGHUP);
  ASSERT_TRUE(daemon.process().wait_for_text("a.wav is still there: move it away", kTimeout));
  fs::rename(wav, file("first.wav"));
  daemon.process().signal(SIGHUP);
  ASSERT_TRUE(daemon.process().wait_for_text("began " + wav + " anew", kTimeout));
  sleep(0.3);
  EXPECT_EQ(daemon.end(), 0) << daemon.process().output();
  const std::size_t first = read_recording(file("first.wav")).channels.at(0).size();
  const std::size_t second = read_recording(wav).channels.at(0).size();
  EXPECT_GT(first, 10000U);
  EXPECT_GT(second, 5000U);
}

/// A program at a terminal of its own, which prints its process ID first.
Arguments at_terminal(const Arguments& program) {
  std::string line = "echo pid $$.; exec ";
  for (const std::string& word : program) line += "'" + word + "' ";
  return {"/usr/bin/script", "-qec", line, "/dev/null"};
}

pid_t pid_in(const std::string& output) {
  return static_cast<pid_t>(std::stol(output.substr(output.find("pid ") + 4)));
}

/// SIGHUP comes from a terminal that closes, and from who asks for files to be begun anew.
TEST_F(Signals, ATerminalThatClosesEndsItsProgramInPeace) {
  if (!fs::exists("/usr/bin/script")) GTEST_SKIP() << "there is no /usr/bin/script";
  const std::string report = file("terminal.json");
  ChildProcess terminal(at_terminal(command(
      "sim-server",
      simulator({"--listen", "127.0.0.1:0", "--report", report, "--record", file("a.osc")}))));
  ASSERT_TRUE(terminal.wait_for_text("listening: ", kTimeout)) << terminal.output();
  ASSERT_EQ(kill(pid_in(terminal.output()), SIGHUP), 0);
  ASSERT_TRUE(terminal.wait_for_text("a.osc is still there: move it away", kTimeout));
  EXPECT_FALSE(fs::exists(report));
  terminal.signal(SIGKILL);
  terminal.wait_for_end();
  EXPECT_TRUE(eventually([&] { return fs::exists(report); }, kTimeout));
}

TEST_F(Signals, TheSynthReadsItsSoundAgainAtATerminal) {
  if (!fs::exists("/usr/bin/script")) GTEST_SKIP() << "there is no /usr/bin/script";
  const std::string wav = file("a.wav");
  ChildProcess terminal(at_terminal(
      command("synth-server", synth({"--listen", "127.0.0.1:0", "--record-audio", wav}))));
  ASSERT_TRUE(terminal.wait_for_text("listening: ", kTimeout)) << terminal.output();
  const pid_t program = pid_in(terminal.output());
  ASSERT_EQ(kill(program, SIGHUP), 0);
  ASSERT_TRUE(terminal.wait_for_text("a.wav is still there: move it away", kTimeout));
  ASSERT_EQ(kill(program, SIGTERM), 0);
  EXPECT_EQ(terminal.wait_for_end(), 0) << terminal.output();
}

TEST_F(Signals, AReaderThatGoesAwayEndsNothing) {
  const std::string report = file("pipe.json");
  ChildProcess shell({"/bin/sh", "-c", "\"$0\" \"$@\" | head -1", command("sim-server", {})[0],
                      "--scene", simulator()[1], "--listen", "127.0.0.1:0", "--duration", "1",
                      "--faster-than-real-time", "--report", report});
  EXPECT_EQ(shell.wait_for_end(), 0);
  EXPECT_TRUE(eventually([&] { return fs::exists(report); }, kTimeout)) << shell.output();
}

}  // namespace
}  // namespace splash::tests
