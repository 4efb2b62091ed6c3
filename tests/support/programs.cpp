// SPDX-License-Identifier: MIT
#include "tests/support/programs.hpp"

#include <unistd.h>

#include <algorithm>
#include <cctype>
#include <filesystem>
#include <optional>
#include <stdexcept>

#include "protocol/time_tag.hpp"

namespace splash::tests {
namespace {

/// 127.0.0.2: not the address from which a program's partner asks.
constexpr std::uint32_t kOwnHost = INADDR_LOOPBACK + 1;

/// The endpoint that the program prints behind `label`.
protocol::Endpoint announced(ChildProcess& process, const std::string& label) {
  const double limit = protocol::monotonic_now() + 120.0;  // OpenCL compiles on a first start
  while (process.running() && protocol::monotonic_now() < limit) {
    if (!process.wait_for_text(label, 1.0)) continue;
    const std::string output = process.output();
    const auto start = output.find(label) + label.size();
    const auto end = output.find('\n', start);
    if (end == std::string::npos) continue;
    return protocol::parse_endpoint(output.substr(start, end - start), 0);
  }
  throw std::runtime_error("it never said '" + label + "':\n" + process.output());
}

}  // namespace

std::string temporary_path(const std::string& name) {
  return std::filesystem::temp_directory_path() /
         ("splash-" + std::to_string(getpid()) + "-" + name);
}

std::string rig_path(const std::string& name) {
  return std::string(SPLASH_SOURCE_DIR) + "/configs/rigs/" + name;
}

Arguments command(const std::string& name, const Arguments& arguments) {
  Arguments all{std::string(SPLASH_BINARY_DIR) + "/" + name};
  all.insert(all.end(), arguments.begin(), arguments.end());
  return all;
}

Arguments on_some_port(Arguments arguments) {
  if (std::find(arguments.begin(), arguments.end(), "--listen") == arguments.end()) {
    arguments.insert(arguments.end(), {"--listen", "127.0.0.1:0"});
  }
  return arguments;
}

Ended run_command(const Arguments& words, double seconds,
                  const ChildProcess::Environment& environment) {
  ChildProcess process(words, environment);
  const int code = process.wait_for_end(seconds);
  return {code, process.output()};
}

Ended run_program(const std::string& name, const Arguments& arguments, double seconds,
                  const ChildProcess::Environment& environment) {
  return run_command(command(name, arguments), seconds, environment);
}

Ended run_shell(const std::string& line, double seconds) {
  return run_command({"/bin/sh", "-c", line}, seconds);
}

Daemon::Daemon(const std::string& name, const Arguments& arguments,
               const ChildProcess::Environment& environment)
    : process_(command(name, on_some_port(arguments)), environment),
      endpoint_(announced(process_, "listening: ")),
      socket_(protocol::Endpoint{kOwnHost, 0}) {}

protocol::Endpoint Daemon::viewers() {
  return announced(process_, "viewers: ");
}

protocol::Message Daemon::ask(const protocol::Message& command, const std::string& address) {
  const double limit = protocol::monotonic_now() + 20.0;
  double again = 0.0;  // who was asked too often in a second says nothing: ask in the next one
  std::vector<std::byte> buffer(2048);
  while (protocol::monotonic_now() < limit) {
    if (protocol::monotonic_now() >= again) {
      send(protocol::encode(command));
      again = protocol::monotonic_now() + 1.5;
    }
    const auto received = socket_.receive(buffer.data(), buffer.size(), 0.1);
    if (!received) continue;
    const auto decoded = protocol::decode({buffer.data(), received->size});
    for (const auto& message : decoded.packet.messages) {
      if (message.address == address) return message;
    }
  }
  return {};
}

namespace {

template <class Status>
Status known(const std::optional<Status>& status, Daemon& daemon) {
  if (!status) throw std::runtime_error("no status:\n" + daemon.process().output());
  return *status;
}

}  // namespace

protocol::SynthStatus Synth::status() {
  return known(protocol::to_synth_status(ask({"/status", {}}, "/status.reply")), *this);
}

protocol::SimStatus Simulator::status() {
  return known(protocol::to_sim_status(ask({"/status", {}}, "/status.reply")), *this);
}

long number_before(const std::string& text, const std::string& words) {
  const auto found = text.find(" " + words);
  if (found == std::string::npos) return -1;
  auto start = found;
  while (start > 0 && std::isdigit(static_cast<unsigned char>(text[start - 1])) != 0) --start;
  return start == found ? -1 : std::stol(text.substr(start, found - start));
}

}  // namespace splash::tests
