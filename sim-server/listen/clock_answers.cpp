// SPDX-License-Identifier: MIT
#include "sim-server/listen/clock_answers.hpp"

#include <algorithm>
#include <array>
#include <utility>
#include <variant>

#include "protocol/address.hpp"
#include "protocol/control.hpp"
#include "protocol/limits.hpp"
#include "protocol/message.hpp"
#include "protocol/reply_budget.hpp"
#include "protocol/time_tag.hpp"
#include "sim-server/send/lo_packet.hpp"

namespace splash::sim {
namespace {

constexpr double kLookForStop = 0.1;  // [s]

}  // namespace

ClockAnswers::ClockAnswers(protocol::UdpSocket& socket, const Targets& targets, Print print)
    : socket_(socket),
      targets_(targets),
      print_(std::move(print)),
      thread_([this](const std::stop_token& stop) { listen(stop); }) {}

void ClockAnswers::listen(const std::stop_token& stop) {
  std::array<std::byte, protocol::kMaxDatagram + 4> buffer{};  // longer ones are known as such
  while (!stop.stop_requested()) {
    const auto received = socket_.receive(buffer.data(), buffer.size(), kLookForStop);
    if (!received) continue;
    const auto size = std::min(received->size, buffer.size());
    take(protocol::Bytes(buffer).first(size), received->from);
  }
}

void ClockAnswers::take(protocol::Bytes packet, const protocol::Endpoint& from) {
  const auto arrived = protocol::to_time_tag(protocol::unix_now());
  if (!is_target(from)) return;
  const auto decoded = protocol::decode(packet);
  protocol::ReplyBudget budget(from, packet.size());
  for (const protocol::Message& message : decoded.packet.messages) {
    if (message.address != "/ping" || protocol::violation(message)) continue;
    if (!replies_.allow(from, protocol::monotonic_now())) return;
    const auto sent = std::get<protocol::TimeTag>(message.arguments.front());
    const auto now = protocol::to_time_tag(protocol::unix_now());
    const protocol::Message pong = protocol::pong(sent, arrived, now);
    if (!budget.take(pong)) {
      withhold(from, budget.complaint(message.address, pong));
    } else if (socket_.send_to(from, build_message(pong))) {
      ++answered_;
    }
  }
}

void ClockAnswers::withhold(const protocol::Endpoint& from, const std::string& why) {
  ++withheld_;
  if (!print_ || !reports_.allow(from, protocol::monotonic_now())) return;
  print_(protocol::to_string(from) + ' ' + why);
}

bool ClockAnswers::is_target(const protocol::Endpoint& from) const {
  const auto targets = targets_.list();
  return std::any_of(targets.begin(), targets.end(),
                     [&](const Target& target) { return target.endpoint.address == from.address; });
}

}  // namespace splash::sim
