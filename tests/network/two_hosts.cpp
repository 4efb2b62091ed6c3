// SPDX-License-Identifier: MIT
#include "tests/network/two_hosts.hpp"

#include <fcntl.h>
#include <netinet/in.h>
#include <netinet/ip.h>
#include <netinet/udp.h>
#include <sched.h>
#include <sys/socket.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <fstream>
#include <sstream>
#include <stdexcept>
#include <thread>

#include "protocol/limits.hpp"
#include "tests/support/child_process.hpp"

namespace splash::network {
namespace {

/// What the command printed when it failed; empty: it did not.
std::string complaint_of(const std::string& command) {
  std::istringstream words(command);
  std::vector<std::string> arguments;
  for (std::string word; words >> word;) arguments.push_back(word);
  tests::ChildProcess process(arguments);
  if (process.wait_for_end(20.0) == 0) return {};
  return "'" + command + "': " + process.output();
}

/// Runs `work` in another network namespace: sockets opened there stay there. In a thread of its
/// own, which ends there.
template <class Work>
void inside(const std::string& name, Work&& work) {
  std::string problem;
  std::thread([&] {
    const int there = open(("/var/run/netns/" + name).c_str(), O_RDONLY | O_CLOEXEC);
    if (there < 0 || setns(there, CLONE_NEWNET) != 0) problem = "cannot enter " + name;
    if (there >= 0) close(there);
    if (!problem.empty()) return;
    try {
      work();
    } catch (const std::exception& error) {
      problem = error.what();
    }
  }).join();
  if (!problem.empty()) throw std::runtime_error(problem);
}

}  // namespace

std::string TwoHosts::name(int host) const {
  return "splash-" + std::to_string(getpid()) + (host == 0 ? "-sim" : "-synth");
}

TwoHosts::TwoHosts() {
  const std::string first = name(0);
  const std::string second = name(1);
  for (const std::string& command :
       {"ip netns add " + first, "ip netns add " + second,
        "ip link add cable netns " + first + " type veth peer name cable netns " + second,
        "ip -n " + first + " addr add 10.77.0.1/24 dev cable",
        "ip -n " + first + " addr add 10.77.0.3/24 dev cable",
        "ip -n " + second + " addr add 10.77.0.2/24 dev cable",
        "ip -n " + first + " link set lo up", "ip -n " + second + " link set lo up",
        "ip -n " + first + " link set cable up", "ip -n " + second + " link set cable up"}) {
    why_not_ = complaint_of(command);
    if (!why_not_.empty()) return;
  }
}

TwoHosts::~TwoHosts() {
  for (const int host : {0, 1}) (void)complaint_of("ip netns del " + name(host));
}

std::vector<std::string> TwoHosts::command_on(int host, std::vector<std::string> command) const {
  const std::vector<std::string> there{"ip", "netns", "exec", name(host)};
  command.insert(command.begin(), there.begin(), there.end());
  return command;
}

protocol::UdpSocket TwoHosts::socket_on(int host, const std::string& endpoint) const {
  std::optional<protocol::UdpSocket> socket;
  inside(name(host), [&] { socket.emplace(protocol::parse_endpoint(endpoint, 0)); });
  return std::move(*socket);
}

void TwoHosts::send_forged(int host, const protocol::Endpoint& sender, const protocol::Endpoint& to,
                           protocol::Bytes payload) const {
  struct Packet {
    iphdr ip{};
    udphdr udp{};
    std::array<std::byte, protocol::kMaxDatagram> payload{};
  } packet;
  const std::size_t size = sizeof packet.udp + payload.size();
  packet.ip.version = 4;
  packet.ip.ihl = 5;
  packet.ip.ttl = 64;
  packet.ip.protocol = IPPROTO_UDP;
  packet.ip.saddr = htonl(sender.address);
  packet.ip.daddr = htonl(to.address);  // the kernel fills in length and checksum
  packet.udp.source = htons(sender.port);
  packet.udp.dest = htons(to.port);
  packet.udp.len = htons(static_cast<std::uint16_t>(size));
  std::copy(payload.begin(), payload.end(), packet.payload.begin());
  inside(name(host), [&] {
    const int raw = socket(AF_INET, SOCK_RAW | SOCK_CLOEXEC, IPPROTO_RAW);
    sockaddr_in peer{};
    peer.sin_family = AF_INET;
    peer.sin_addr.s_addr = packet.ip.daddr;
    const auto sent = sendto(raw, &packet, sizeof packet.ip + size, 0,
                             reinterpret_cast<const sockaddr*>(&peer), sizeof peer);
    if (raw >= 0) close(raw);
    if (sent < 0) throw std::runtime_error("cannot send a forged datagram");
  });
}

std::uint64_t TwoHosts::received_on(int host) const {
  std::uint64_t packets = 0;
  inside(name(host), [&] {
    std::ifstream table("/proc/thread-self/net/dev");
    for (std::string line; std::getline(table, line);) {
      std::istringstream words(line);
      std::string interface;
      std::uint64_t bytes = 0;
      if (words >> interface && interface == "cable:") words >> bytes >> packets;
    }
  });
  return packets;
}

std::vector<std::string> TwoHosts::listening_on(int host) const {
  std::vector<std::string> found;
  inside(name(host), [&] {
    std::ifstream table("/proc/thread-self/net/udp");
    std::string line;
    std::getline(table, line);  // the heads of the columns
    while (std::getline(table, line)) {
      std::istringstream words(line);
      std::string number;
      std::string local;
      words >> number >> local;
      found.push_back(local);
    }
  });
  return found;
}

}  // namespace splash::network
