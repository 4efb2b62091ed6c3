// SPDX-License-Identifier: MIT
#include "tests/synth-server/live/daemon.hpp"

#include <fcntl.h>
#include <gtest/gtest.h>
#include <poll.h>
#include <sys/prctl.h>
#include <sys/wait.h>
#include <unistd.h>

#include <array>
#include <chrono>
#include <csignal>
#include <stdexcept>

namespace splash::synth {
namespace {

double now() {
  return protocol::monotonic_now();
}

}  // namespace

std::string temporary_path(const std::string& name) {
  return testing::TempDir() + "splash-" + std::to_string(getpid()) + "-" + name;
}

std::string rig_path(const std::string& name) {
  return std::string(SPLASH_SOURCE_DIR) + "/configs/rigs/" + name;
}

Daemon::Daemon(const std::string& path, const std::vector<std::string>& arguments) {
  std::vector<char*> argv{const_cast<char*>(path.c_str())};
  for (const auto& argument : arguments) argv.push_back(const_cast<char*>(argument.c_str()));
  argv.push_back(nullptr);
  std::array<int, 2> ends{};
  if (pipe2(ends.data(), O_CLOEXEC) != 0) throw std::runtime_error("no pipe");
  pid_ = fork();
  if (pid_ == 0) {
    prctl(PR_SET_PDEATHSIG, SIGKILL);  // nothing outlives a test that was killed
    dup2(ends[1], STDOUT_FILENO);
    dup2(ends[1], STDERR_FILENO);
    execvp(argv[0], argv.data());
    _exit(127);
  }
  close(ends[1]);
  pipe_ = ends[0];
}

Daemon::~Daemon() {
  if (!ended_ && !reap(false)) {
    kill(pid_, SIGKILL);
    reap(true);
  }
  close(pipe_);
}

bool Daemon::reap(bool wait) {
  if (ended_) return true;
  int status = 0;
  if (waitpid(pid_, &status, wait ? 0 : WNOHANG) != pid_) return false;
  ended_ = true;
  status_ = WIFEXITED(status) ? WEXITSTATUS(status) : -WTERMSIG(status);
  return true;
}

bool Daemon::running() {
  return !reap(false);
}

bool Daemon::read_some(double seconds) {
  pollfd readable{pipe_, POLLIN, 0};
  if (poll(&readable, 1, static_cast<int>(1e3 * seconds)) <= 0) return true;
  std::array<char, 4096> buffer{};
  const ssize_t count = read(pipe_, buffer.data(), buffer.size());
  if (count <= 0) return false;
  output_.append(buffer.data(), static_cast<std::size_t>(count));
  return true;
}

bool Daemon::wait_for_text(const std::string& text, double seconds) {
  const double limit = now() + seconds;
  while (output_.find(text) == std::string::npos) {
    if (now() > limit || !read_some(0.05)) return output_.find(text) != std::string::npos;
  }
  return true;
}

void Daemon::signal(int number) const {
  kill(pid_, number);
}

int Daemon::wait_for_end(double seconds) {
  const double limit = now() + seconds;
  while (read_some(0.05) && now() < limit) {
  }
  if (now() >= limit) kill(pid_, SIGKILL);
  reap(true);
  return status_;
}

namespace {

std::vector<std::string> on_free_port(std::vector<std::string> arguments) {
  arguments.insert(arguments.end(), {"--listen", "127.0.0.1:0"});
  return arguments;
}

/// The endpoint that the program says it listens on.
protocol::Endpoint announced(Daemon& daemon) {
  const std::string label = "listening: ";
  if (!daemon.wait_for_text(label)) throw std::runtime_error("no start:\n" + daemon.output());
  const auto start = daemon.output().find(label) + label.size();
  daemon.wait_for_text("\n");
  while (daemon.output().find('\n', start) == std::string::npos && daemon.running()) {
    daemon.wait_for_text("never said", 0.05);
  }
  const auto end = daemon.output().find('\n', start);
  return protocol::parse_endpoint(daemon.output().substr(start, end - start), 0);
}

}  // namespace

Synth::Synth(std::vector<std::string> arguments)
    : daemon_(std::string(SPLASH_BINARY_DIR) + "/synth-server", on_free_port(std::move(arguments))),
      endpoint_(announced(daemon_)),
      socket_(protocol::Endpoint{INADDR_LOOPBACK, 0}) {}

protocol::Message Synth::ask(const protocol::Message& command, const std::string& address) {
  send(protocol::encode(command));
  const double limit = now() + 20.0;
  std::vector<std::byte> buffer(2048);
  while (now() < limit) {
    const auto received = socket_.receive(buffer.data(), buffer.size(), 0.1);
    if (!received) continue;
    const auto decoded = protocol::decode({buffer.data(), received->size});
    for (const auto& message : decoded.packet.messages) {
      if (message.address == address) return message;
    }
  }
  return {};
}

}  // namespace splash::synth
