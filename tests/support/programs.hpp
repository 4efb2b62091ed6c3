// SPDX-License-Identifier: MIT
// The real programs as child processes on free loopback ports: started, spoken to, ended for sure.
#pragma once

#include <string>
#include <vector>

#include "protocol/message.hpp"
#include "protocol/status.hpp"
#include "protocol/udp_socket.hpp"
#include "tests/support/child_process.hpp"

namespace splash::tests {

/// A name below the test's temporary folder that no other process uses.
[[nodiscard]] std::string temporary_path(const std::string& name);
[[nodiscard]] std::string rig_path(const std::string& name);

using Arguments = std::vector<std::string>;

/// `name` out of the build's programs, with its arguments: what ChildProcess takes.
[[nodiscard]] Arguments command(const std::string& name, const Arguments& arguments);

/// With --listen and a free port unless they have one.
[[nodiscard]] Arguments on_some_port(Arguments arguments);

struct Ended {
  int code = 0;
  std::string text;  ///< all it printed
};
/// Runs what ChildProcess takes until it ends.
[[nodiscard]] Ended run_command(const Arguments& words, double seconds,
                                const ChildProcess::Environment& environment = {});
/// The same with a program of ours.
[[nodiscard]] Ended run_program(const std::string& name, const Arguments& arguments,
                                double seconds = 120.0,
                                const ChildProcess::Environment& environment = {});

/// Runs a command as a user would type it.
[[nodiscard]] Ended run_shell(const std::string& line, double seconds = 120.0);

/// A program that says "listening: host:port", with the end of a socket to talk to it.
class Daemon {
 public:
  /// On some port; waits until it listens.
  Daemon(const std::string& name, const Arguments& arguments,
         const ChildProcess::Environment& environment = {});

  ChildProcess& process() noexcept { return process_; }
  /// As ChildProcess has them.
  int end() { return process_.end(); }
  void kill() { process_.kill(); }
  [[nodiscard]] protocol::Endpoint endpoint() const noexcept { return endpoint_; }
  /// Where it lets viewers in, when it was started with --show.
  [[nodiscard]] protocol::Endpoint viewers();
  void send(const std::vector<std::byte>& bytes) { socket_.send_to(endpoint_, bytes); }
  /// Sends a command and returns the first reply at `address`; empty when there is none.
  protocol::Message ask(const protocol::Message& command, const std::string& address);

 private:
  ChildProcess process_;
  protocol::Endpoint endpoint_;
  protocol::UdpSocket socket_;
};

class Synth : public Daemon {
 public:
  explicit Synth(const Arguments& arguments, const ChildProcess::Environment& environment = {})
      : Daemon("synth-server", arguments, environment) {}
  /// Throws std::runtime_error with what it printed when it does not answer.
  [[nodiscard]] protocol::SynthStatus status();
};

class Simulator : public Daemon {
 public:
  explicit Simulator(const Arguments& arguments, const ChildProcess::Environment& environment = {})
      : Daemon("sim-server", arguments, environment) {}
  /// The same.
  [[nodiscard]] protocol::SimStatus status();
};

/// The whole number that stands before the first `words` in `text`; -1: none.
[[nodiscard]] long number_before(const std::string& text, const std::string& words);

}  // namespace splash::tests
