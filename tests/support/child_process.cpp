// SPDX-License-Identifier: MIT
#include "tests/support/child_process.hpp"

#include <fcntl.h>
#include <sys/mman.h>
#include <sys/prctl.h>
#include <sys/wait.h>
#include <unistd.h>

#include <array>
#include <cerrno>
#include <chrono>
#include <csignal>
#include <cstdlib>
#include <cstring>
#include <stdexcept>
#include <thread>

namespace splash::tests {
namespace {

using Clock = std::chrono::steady_clock;

Clock::time_point in(double seconds) {
  return Clock::now() +
         std::chrono::duration_cast<Clock::duration>(std::chrono::duration<double>(seconds));
}

void pause() {
  std::this_thread::sleep_for(std::chrono::milliseconds(5));
}

/// In the child: never returns.
[[noreturn]] void become(const std::vector<std::string>& arguments,
                         const ChildProcess::Environment& environment, int output) {
  prctl(PR_SET_PDEATHSIG, SIGKILL);  // a test that is killed takes its children along
  const int nothing = open("/dev/null", O_RDONLY);
  if (nothing < 0) _exit(126);
  dup2(nothing, STDIN_FILENO);
  dup2(output, STDOUT_FILENO);
  dup2(output, STDERR_FILENO);
  for (const auto& [name, value] : environment) setenv(name.c_str(), value.c_str(), 1);
  std::vector<char*> argv;
  for (const std::string& argument : arguments) argv.push_back(const_cast<char*>(argument.c_str()));
  argv.push_back(nullptr);
  execvp(argv[0], argv.data());
  _exit(127);
}

}  // namespace

ChildProcess::ChildProcess(const std::vector<std::string>& arguments,
                           const Environment& environment)
    : output_(memfd_create("output", MFD_CLOEXEC)) {
  if (output_ < 0) throw std::runtime_error(std::string("memfd_create: ") + std::strerror(errno));
  pid_ = fork();
  if (pid_ < 0) throw std::runtime_error(std::string("fork: ") + std::strerror(errno));
  if (pid_ == 0) become(arguments, environment, output_);
}

ChildProcess::~ChildProcess() {
  if (!status_) {
    signal(SIGTERM);
    wait_for_end(2.0);
  }
  close(output_);
}

std::optional<int> ChildProcess::wait(double seconds) {
  const auto deadline = in(seconds);
  while (!status_) {
    int status = 0;
    const pid_t ended = waitpid(pid_, &status, WNOHANG);
    if (ended == pid_) status_ = WIFEXITED(status) ? WEXITSTATUS(status) : 128 + WTERMSIG(status);
    if (ended < 0) status_ = 255;
    if (status_ || Clock::now() >= deadline) break;
    pause();
  }
  return status_;
}

int ChildProcess::wait_for_end(double seconds) {
  if (!wait(seconds)) signal(SIGKILL);
  return wait(10.0).value_or(255);
}

bool ChildProcess::wait_for_text(const std::string& text, double seconds) {
  const auto deadline = in(seconds);
  for (;;) {
    const bool last = !running() || Clock::now() >= deadline;
    if (output().find(text) != std::string::npos) return true;
    if (last) return false;
    pause();
  }
}

void ChildProcess::signal(int number) const {
  if (!status_) ::kill(pid_, number);
}

int ChildProcess::end() {
  signal(SIGTERM);
  return wait_for_end();
}

void ChildProcess::kill() {
  signal(SIGKILL);
  wait_for_end();
}

std::string ChildProcess::output() const {
  std::string text;
  std::array<char, 4096> piece{};
  for (;;) {  // not read(): the offset is the child's as well
    const ssize_t got = pread(output_, piece.data(), piece.size(), static_cast<off_t>(text.size()));
    if (got <= 0) return text;
    text.append(piece.data(), static_cast<std::size_t>(got));
  }
}

}  // namespace splash::tests
