// SPDX-License-Identifier: MIT
// Both programs under a service manager: ready when they can be spoken to, alive while every thread
// of theirs moves on, stopping when they are told to.
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <sys/ptrace.h>
#include <sys/wait.h>

#include <csignal>
#include <filesystem>
#include <memory>

#include "tests/support/programs.hpp"
#include "tests/support/small_scene.hpp"
#include "tests/system/notify_socket.hpp"

namespace splash::tests {
namespace {

using testing::HasSubstr;
using testing::StartsWith;

constexpr double kTimeout = 60.0;  ///< [s]
constexpr const char* kPeriod = "400000";
/// A busy machine may keep a thread from its turn, but not for so long [s].
constexpr double kSilence = 1.0;

#ifdef __SANITIZE_THREAD__
constexpr int kSanitizersOwn = 1;  ///< a thread of ThreadSanitizer, in the programs as well
#else
constexpr int kSanitizersOwn = 0;
#endif

struct Program {
  const char* name;
  bool simulates;
};

void PrintTo(const Program& program, std::ostream* out) {
  *out << program.name;
}

class Service : public testing::TestWithParam<Program> {
 protected:
  std::unique_ptr<Daemon> start(NotifySocket& manager, const std::string& period = kPeriod) const {
    const Arguments synth{"--rig", rig_path("stereo.yaml"), "--device", "null"};
    return std::make_unique<Daemon>(
        GetParam().name, GetParam().simulates ? Arguments{"--scene", scene_.path()} : synth,
        ChildProcess::Environment{{"NOTIFY_SOCKET", manager.address()}, {"WATCHDOG_USEC", period}});
  }

 private:
  SmallScene scene_{plunging()};
};

/// One thread of another process, stopped while this lives; the others run on.
class StoppedThread {
 public:
  explicit StoppedThread(pid_t thread) : thread_(thread) {
    int status = 0;
    stopped_ = ptrace(PTRACE_SEIZE, thread, nullptr, nullptr) == 0 &&
               ptrace(PTRACE_INTERRUPT, thread, nullptr, nullptr) == 0 &&
               waitpid(thread, &status, __WALL) == thread;
  }
  ~StoppedThread() {
    if (stopped_) ptrace(PTRACE_DETACH, thread_, nullptr, nullptr);
  }
  StoppedThread(const StoppedThread&) = delete;
  StoppedThread& operator=(const StoppedThread&) = delete;
  [[nodiscard]] bool stopped() const noexcept { return stopped_; }

 private:
  pid_t thread_;
  bool stopped_ = false;
};

std::vector<pid_t> threads_of(pid_t process) {
  std::vector<pid_t> threads;
  const auto folder = std::filesystem::path("/proc") / std::to_string(process) / "task";
  for (const auto& entry : std::filesystem::directory_iterator(folder)) {
    threads.push_back(std::stoi(entry.path().filename()));
  }
  return threads;
}

TEST_P(Service, IsReadyWhenItCanBeSpokenTo) {
  NotifySocket manager;
  const SmallScene scene(plunging());
  ChildProcess process(
      command(GetParam().name, GetParam().simulates
                                   ? Arguments{"--scene", scene.path(), "--listen", "127.0.0.1:0"}
                                   : Arguments{"--rig", rig_path("stereo.yaml"), "--device", "null",
                                               "--listen", "127.0.0.1:0"}),
      {{"NOTIFY_SOCKET", manager.address()}});
  if (GetParam().simulates) {
    EXPECT_NE(manager.wait_for("EXTEND_TIMEOUT_USEC=", kTimeout), "") << "while the water settles";
  }
  const std::string ready = manager.wait_for("READY=1\n", kTimeout);
  const std::string said = process.output();  // before it could say more
  ASSERT_THAT(ready, HasSubstr("\nSTATUS=")) << said;
  const std::string endpoint = ready.substr(ready.rfind(' ') + 1);
  EXPECT_THAT(said, HasSubstr("listening: " + endpoint));
  protocol::UdpSocket socket({INADDR_LOOPBACK, 0});
  socket.send_to(protocol::parse_endpoint(endpoint, 0), protocol::encode({"/sync", {7}}));
  std::vector<std::byte> answer(2048);
  EXPECT_TRUE(socket.receive(answer.data(), answer.size(), kTimeout));
  if (GetParam().simulates) {
    EXPECT_THAT(said, HasSubstr("kernels ready"));
  }
}

TEST_P(Service, StopsWithAWord) {
  NotifySocket manager(true);
  const auto daemon = start(manager);
  daemon->process().signal(SIGTERM);
  EXPECT_EQ(manager.wait_for("STOPPING=1", kTimeout), "STOPPING=1");
  EXPECT_EQ(daemon->process().wait_for_end(), 0) << daemon->process().output();
  EXPECT_EQ(manager.wait_for("WATCHDOG=1", 0.1), "") << "nothing after the end";
}

TEST_P(Service, GivesSignsOfLifeUntilAnyOfItsThreadsHangs) {
  NotifySocket manager;
  const auto daemon = start(manager);
  for (int k = 0; k < 3; ++k) ASSERT_EQ(manager.wait_for("WATCHDOG=1", kTimeout), "WATCHDOG=1");
  const pid_t process = daemon->process().id();
  int hung = 0;
  int immune = 0;
  for (const pid_t thread : threads_of(process)) {
    // Of the simulator's, OpenCL's workers: any of them may be idle, another takes its work.
    if (GetParam().simulates && thread != process && hung == 2) continue;
    const StoppedThread stopped(thread);
    if (!stopped.stopped()) GTEST_SKIP() << "ptrace is not allowed here";
    manager.wait_for("nothing begins like this", 0.3);  // what was on its way
    const bool alive = !manager.wait_for("WATCHDOG=1", kSilence).empty();
    if (GetParam().simulates && thread != process) {
      hung += alive ? 0 : 1;
    } else {
      immune += alive ? 1 : 0;
    }
  }
  EXPECT_EQ(immune, GetParam().simulates ? 0 : kSanitizersOwn)
      << "threads whose hang nobody would see";
  if (GetParam().simulates) {
    EXPECT_GE(hung, 1) << "the thread that listens";
  }
  EXPECT_EQ(manager.wait_for("WATCHDOG=1", kTimeout), "WATCHDOG=1") << "it recovers";
}

TEST_P(Service, WithoutAWatchdogGivesNone) {
  NotifySocket manager;
  const auto daemon = start(manager, "0");
  EXPECT_THAT(manager.wait_for("READY=1", kTimeout), StartsWith("READY=1"));
  EXPECT_EQ(manager.wait_for("WATCHDOG=1", 0.5), "");
}

TEST(ViewService, IsReadyAndGivesSignsOfLife) {
  NotifySocket manager;
  const Daemon daemon("view-server", {},
                      {{"NOTIFY_SOCKET", manager.address()}, {"WATCHDOG_USEC", kPeriod}});
  EXPECT_THAT(manager.wait_for("READY=1", kTimeout), HasSubstr("STATUS=http://127.0.0.1:"));
  for (int k = 0; k < 3; ++k) EXPECT_EQ(manager.wait_for("WATCHDOG=1", kTimeout), "WATCHDOG=1");
}

std::string name_of(const testing::TestParamInfo<Program>& program) {
  return program.param.simulates ? "Sim" : "Synth";
}

INSTANTIATE_TEST_SUITE_P(Programs, Service,
                         testing::Values(Program{"sim-server", true},
                                         Program{"synth-server", false}),
                         name_of);

}  // namespace
}  // namespace splash::tests
