// SPDX-License-Identifier: MIT
// The launcher with both real programs: what the demo leaves, and Ctrl-C in a terminal, which
// reaches the launcher alone and ends both programs cleanly.
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <pty.h>
#include <sys/wait.h>
#include <unistd.h>

#include <csignal>
#include <filesystem>
#include <fstream>
#include <nlohmann/json.hpp>
#include <set>

#include "protocol/event_log.hpp"
#include "tests/support/programs.hpp"
#include "tests/support/recording.hpp"
#include "tests/support/temporary_folder.hpp"
#include "tests/support/text_of.hpp"
#include "tests/support/waiting.hpp"

namespace splash::tests {
namespace {

namespace fs = std::filesystem;
using testing::HasSubstr;

/// The launcher in a terminal of its own, over programs that are built.
class Terminal {
 public:
  /// `environment`: "NAME=VALUE", for the launcher.
  explicit Terminal(const std::string& arguments, const std::string& environment = "") {
    fs::permissions(tools_.write("cmake", "#!/bin/sh\n"), fs::perms::owner_all);
    const std::string line = environment + " PATH='" + tools_.path().string() + "':$PATH exec " +
                             SPLASH_SOURCE_DIR + "/splash --no-install --build-dir '" +
                             SPLASH_BINARY_DIR + "/..' " + arguments;
    child_ = forkpty(&master_, nullptr, nullptr, nullptr);
    if (child_ == 0) {
      execl("/bin/bash", "bash", "-c", line.c_str(), static_cast<char*>(nullptr));
      _exit(127);
    }
  }
  Terminal(const Terminal&) = delete;
  Terminal& operator=(const Terminal&) = delete;
  ~Terminal() {
    if (!ended_) {
      kill(child_, SIGTERM);
      wait_for_end();
    }
    close(master_);
  }

  bool wait_for_text(const std::string& text) {
    while (text_.find(text) == std::string::npos) {
      if (!read_more()) return false;
    }
    return true;
  }
  void press_ctrl_c() const { EXPECT_EQ(write(master_, "\x03", 1), 1); }
  int wait_for_end() {
    while (read_more()) {
    }
    int status = 0;
    waitpid(child_, &status, 0);
    ended_ = true;
    return WIFEXITED(status) ? WEXITSTATUS(status) : -WTERMSIG(status);
  }
  [[nodiscard]] const std::string& text() const { return text_; }

 private:
  bool read_more() {
    char bytes[4096];
    const ssize_t count = read(master_, bytes, sizeof bytes);
    if (count > 0) text_.append(bytes, static_cast<std::size_t>(count));
    return count > 0;
  }

  TemporaryFolder tools_;
  std::string text_;
  int master_ = -1;
  pid_t child_ = -1;
  bool ended_ = false;
};

TEST(LauncherEnding, CtrlCLetsBothProgramsCloseTheirFiles) {
  const TemporaryFolder folder;
  const std::string log = folder / "ctrl-c.osc";
  const std::string report = folder / "ctrl-c.json";
  Terminal terminal("run basin --record " + log + " --report " + report);
  ASSERT_TRUE(terminal.wait_for_text("real time x")) << terminal.text();
  terminal.press_ctrl_c();
  EXPECT_EQ(terminal.wait_for_end(), 130) << terminal.text();

  EXPECT_THAT(terminal.text(), HasSubstr("pacing ")) << "the simulator's closing words";
  const auto entries = protocol::read_log(log);
  ASSERT_FALSE(entries.empty());
  EXPECT_TRUE(protocol::to_frame(entries.back().messages.at(0))) << "a /frame closes the log";
  const auto told = nlohmann::json::parse(std::ifstream(report));
  EXPECT_NEAR(entries.back().seconds, told["simulated_seconds"].get<double>(), 0.1);

  EXPECT_THAT(terminal.text(), testing::ContainsRegex("ran [0-9.]+ s: played"));
  // A simulator that a busy machine keeps from its word for 0.3 s has departed once before.
  EXPECT_THAT(terminal.text(), testing::ContainsRegex(" [1-9][0-9]* departures"))
      << "the simulator said that it leaves";
}

// The simulator's progress lines go to its log alone.
TEST(LauncherPlay, TheAddressOfThePageStaysInSight) {
  const TemporaryFolder folder;
  Terminal terminal("play --out '" + folder.path().string() + "'");
  ASSERT_TRUE(terminal.wait_for_text("Open http://")) << terminal.text();
  ASSERT_TRUE(terminal.wait_for_text("Ctrl-C ends all")) << terminal.text();
  const auto progress = [&] {
    return text_of(folder / "sim.log").find("real time x") != std::string::npos;
  };
  EXPECT_TRUE(eventually(progress, 60.0, 0.1));
  terminal.press_ctrl_c();
  EXPECT_EQ(terminal.wait_for_end(), 130) << terminal.text();

  const std::string& text = terminal.text();
  const std::size_t open = text.find("Open http://") + 5;
  const std::string address = text.substr(open, text.find_first_of("\r\n", open) - open);
  EXPECT_THAT(text, HasSubstr("running: " + address + " Ctrl-C ends all"));
  EXPECT_THAT(text, testing::Not(HasSubstr("real time x"))) << "it would scroll the address away";
  EXPECT_THAT(text, HasSubstr("pacing ")) << "the simulator's closing words";
}

// The picture is of the recording, and what it is drawn from is cleared away.
TEST(LauncherDemo, LeavesSoundLogFiguresAndPicture) {
  const TemporaryFolder folder;
  Terminal terminal("demo --out '" + folder.path().string() + "'", "SPLASH_DEMO_SECONDS=4");
  EXPECT_EQ(terminal.wait_for_end(), 0) << terminal.text();
  EXPECT_THAT(terminal.text(), HasSubstr("a picture of demo.wav"));
  const Recording wav = read_recording((folder / "demo.wav").string());
  ASSERT_EQ(wav.channels.size(), 2U);
  EXPECT_GT(peak(wav.channels[0]), 0.01F) << "a hand was heard";
  EXPECT_THAT(text_of(folder / "demo.png"), testing::StartsWith("\x89PNG"));
  std::set<std::string> left;
  for (const auto& entry : fs::directory_iterator(folder.path())) {
    left.insert(entry.path().filename().string());
  }
  EXPECT_EQ(left, (std::set<std::string>{"demo.json", "demo.lock", "demo.osc", "demo.png",
                                         "demo.wav", "sim.log", "synth.log"}));
}

}  // namespace
}  // namespace splash::tests
