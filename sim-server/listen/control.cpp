// SPDX-License-Identifier: MIT
// The control's thread: wait, stamp, decode, let the port carry it out, send the replies.
#include "sim-server/listen/control.hpp"

#include <algorithm>
#include <array>
#include <utility>

#include "protocol/arrays.hpp"
#include "protocol/control.hpp"
#include "protocol/time_tag.hpp"
#include "sim-server/send/lo_packet.hpp"

namespace splash::sim {
namespace {

constexpr double kLookForStop = 0.1;  // [s]
/// Somewhat more than a legal datagram, so that a longer one is known as such.
constexpr std::size_t kBuffer = protocol::kMaxDatagram + 4;

}  // namespace

ControlServer::ControlServer(const ControlSettings& settings, ControlActions actions,
                             Targets& targets)
    : actions_(std::move(actions)),
      targets_(targets),
      socket_(settings.listen),
      port_(
          {.program = protocol::kSimProgram, .allowed = settings.allowed, .print = actions_.print},
          actions_.quit) {
  add_commands();
  thread_ = std::jthread([this](const std::stop_token& stop) { listen(stop); });
}

ControlCounts ControlServer::counts() const {
  const std::lock_guard lock(mutex_);
  ControlCounts counts = counts_;
  static_cast<protocol::ControlCounts&>(counts) = port_.counts();
  counts.malformed_poses = port_.violations("/body/pose");
  return counts;
}

void ControlServer::listen(const std::stop_token& stop) {
  std::array<std::byte, kBuffer> buffer{};
  while (!stop.stop_requested()) {
    ++turns_;
    const auto received = socket_.receive(buffer.data(), buffer.size(), kLookForStop);
    if (!received) continue;
    const auto size = std::min(received->size, buffer.size());
    for (const auto& [to, message] : take(protocol::Bytes(buffer).first(size), *received)) {
      socket_.send_to(to, build_message(message));  // UDP may lose
    }
  }
}

std::vector<protocol::Reply> ControlServer::take(protocol::Bytes packet,
                                                 const protocol::UdpSocket::Received& received) {
  const protocol::Endpoint& from = received.from;
  // A busy or stopped program looks late: the kernel knows when it came.
  arrival_ = std::max(arrival_, received.arrival.monotonic);
  std::vector<protocol::Reply> replies;
  const std::lock_guard lock(mutex_);
  ++counts_.packets;
  counts_.dropped = socket_.dropped_by_kernel();
  if (!port_.allows(from)) {
    port_.turn_away(from, arrival_);
    return replies;
  }
  const auto read = protocol::decode_with_arrays(packet);
  if (!port_.inspect(packet, read, from, arrival_)) return replies;
  targets_.renew(from);
  Visit visit{from, arrival_, received.arrival.unix_time, read.packet.time, {from, packet.size()}};
  for (const auto& message : read.packet.messages) port_.take(message, visit, replies);
  return replies;
}

}  // namespace splash::sim
