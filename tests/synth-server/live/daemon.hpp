// SPDX-License-Identifier: MIT
// The real synth-server as a child process: started, spoken to over loopback, ended for sure.
#pragma once

#include <sys/types.h>

#include <string>
#include <vector>

#include "protocol/message.hpp"
#include "protocol/udp_socket.hpp"

namespace splash::synth {

/// A name below the test's temporary folder that no other process uses.
[[nodiscard]] std::string temporary_path(const std::string& name);
[[nodiscard]] std::string rig_path(const std::string& name);

class Daemon {
 public:
  /// Runs the program at `path`; stdout and stderr are collected together.
  Daemon(const std::string& path, const std::vector<std::string>& arguments);
  /// Kills it if it still runs.
  ~Daemon();
  Daemon(const Daemon&) = delete;
  Daemon& operator=(const Daemon&) = delete;

  /// Reads its output until `text` is in it; false when it ends or `seconds` pass before.
  bool wait_for_text(const std::string& text, double seconds = 30.0);
  void signal(int number) const;
  /// Its exit status; -N when signal N ended it. Waits up to `seconds`, then kills it (-9).
  int wait_for_end(double seconds = 30.0);
  [[nodiscard]] bool running();
  [[nodiscard]] const std::string& output() const noexcept { return output_; }

 private:
  bool read_some(double seconds);
  bool reap(bool wait);

  pid_t pid_ = -1;
  int pipe_ = -1;
  int status_ = 0;
  bool ended_ = false;
  std::string output_;
};

/// A synth-server on a free loopback port, with the end of a sender's socket.
class Synth {
 public:
  /// Adds --listen with a free port to `arguments` and waits until it listens.
  explicit Synth(std::vector<std::string> arguments);

  Daemon& daemon() noexcept { return daemon_; }
  [[nodiscard]] protocol::Endpoint endpoint() const noexcept { return endpoint_; }
  void send(const std::vector<std::byte>& bytes) { socket_.send_to(endpoint_, bytes); }
  /// Sends a command and returns the first reply at `address`; empty when there is none.
  protocol::Message ask(const protocol::Message& command, const std::string& address);

 private:
  Daemon daemon_;
  protocol::Endpoint endpoint_;
  protocol::UdpSocket socket_;
};

}  // namespace splash::synth
