// SPDX-License-Identifier: MIT
// splash-listen: what trackers send to this host, and the lines of a scene that map it.
#include <CLI/CLI.hpp>
#include <array>
#include <atomic>
#include <csignal>
#include <cstdio>
#include <limits>
#include <stdexcept>
#include <string>
#include <vector>

#include "program/command_line.hpp"
#include "program/failure.hpp"
#include "protocol/control.hpp"
#include "protocol/limits.hpp"
#include "protocol/time_tag.hpp"
#include "protocol/udp_socket.hpp"
#include "sim-server/tracker_monitor/heard.hpp"
#include "sim-server/tracker_monitor/obstacles.hpp"

namespace {

using namespace splash;
using namespace splash::sim;

constexpr double kPeriod = 0.5;   ///< between two reports [s]
constexpr double kSilence = 5.0;  ///< after which it is said what may be in the way [s]
/// Where senders of VMC, of VRChat's trackers and of TUIO send unless told otherwise.
constexpr std::array<std::uint16_t, 4> kUsualPorts = {protocol::kSimPort, 39539, 9000, 3333};

struct ListenOptions {
  std::vector<std::uint16_t> ports = {};
  double seconds = std::numeric_limits<double>::infinity();
};

std::atomic<bool> asked_to_end = false;

extern "C" void note_end(int /*number*/) {
  asked_to_end = true;
}

struct Ear {
  protocol::UdpSocket socket;
  std::uint16_t port;
};

/// Ports that are taken are told and left out.
std::vector<Ear> open_ears(const std::vector<std::uint16_t>& ports) {
  std::vector<Ear> ears;
  for (const std::uint16_t port : ports) {
    try {
      ears.push_back({protocol::UdpSocket({.address = INADDR_ANY, .port = port}), port});
    } catch (const protocol::SocketError& error) {
      std::printf("%s\n", error.what());
      if (port == protocol::kSimPort) {
        std::printf(
            "a simulator that listens there prints what comes when it is sent /dumpOSC 1\n");
      }
    }
  }
  return ears;
}

std::vector<std::uint16_t> ports_of(const std::vector<Ear>& ears) {
  std::vector<std::uint16_t> ports;
  for (const Ear& ear : ears) ports.push_back(ear.port);
  return ports;
}

void take_all(std::vector<Ear>& ears, Heard& heard) {
  std::array<std::byte, protocol::kMaxDatagram + 4> buffer{};
  // Each ear is waited at in turn, so shortly that none of them overflows.
  const double wait = 0.02 / static_cast<double>(ears.size());
  for (Ear& ear : ears) {
    auto received = ear.socket.receive(buffer.data(), buffer.size(), wait);
    while (received) {
      const auto size = std::min(received->size, buffer.size());
      heard.take(protocol::Bytes(buffer).first(size), received->from, ear.port,
                 protocol::monotonic_now());
      received = ear.socket.receive(buffer.data(), buffer.size(), 0.0);
    }
  }
}

void listen(const ListenOptions& options) {
  std::vector<Ear> ears = open_ears(options.ports);
  if (ears.empty()) {
    throw program::Failure(program::kExitUnavailable,
                           "none of the ports can be listened at: name another");
  }
  std::string list;
  for (const Ear& ear : ears) list += ' ' + std::to_string(ear.port);
  std::printf("listening at UDP port%s, from all hosts; Ctrl-C ends it\n", list.c_str());
  std::fflush(stdout);
  Heard heard;
  const Missed before = missed();
  const double start = protocol::monotonic_now();
  double next = start + kPeriod;
  bool warned = false;
  while (!asked_to_end) {
    take_all(ears, heard);
    const double now = protocol::monotonic_now();
    const bool over = now - start >= options.seconds;
    if (now < next && !over) continue;
    next = now + kPeriod;
    std::fputs(heard.report(now).c_str(), stdout);
    if (!warned && heard.packets() == 0 && (now - start >= kSilence || over)) {
      warned = true;
      const Missed all = missed();
      const Missed since = {all.unwanted - before.unwanted, all.filtered - before.filtered};
      std::printf(
          "nothing has come yet: the sender needs this host's address and one of the ports "
          "above\n%s",
          obstacles(ports_of(ears), since).c_str());
    }
    std::fflush(stdout);
    if (over) break;
  }
}

}  // namespace

int main(int argc, char** argv) {
  ListenOptions options;
  CLI::App app(
      "Prints what trackers send to this host over OSC, and the lines of a scene that map "
      "it to a body.",
      "splash-listen");
  app.set_version_flag("--version", "splash-listen " + protocol::version());
  app.add_option("ports", options.ports,
                 "UDP ports to listen at; left out: 57300 (sim-server), 39539 (VMC), 9000 "
                 "(VRChat), 3333 (TUIO)")
      ->check(CLI::Range(1, 65535))
      ->type_name("PORT");
  app.add_option("--seconds", options.seconds, "End after so many; left out: at Ctrl-C")
      ->check(CLI::PositiveNumber);
  if (const auto code = program::read_command_line(app, argc, argv)) return *code;
  if (options.ports.empty()) options.ports.assign(kUsualPorts.begin(), kUsualPorts.end());
  std::signal(SIGINT, note_end);
  std::signal(SIGTERM, note_end);
  return program::exit_code_of("splash-listen", [&options] { listen(options); });
}
