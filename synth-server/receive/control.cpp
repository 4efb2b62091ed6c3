// SPDX-License-Identifier: MIT
#include "synth-server/receive/control.hpp"

#include <algorithm>
#include <utility>

#include "protocol/address.hpp"
#include "protocol/control.hpp"
#include "synth-server/receive/sender.hpp"

namespace splash::synth {
namespace {

constexpr std::size_t kMostClients = 16;

std::int32_t integer(const protocol::Message& message) {
  return std::get<std::int32_t>(message.arguments.front());
}

}  // namespace

Control::Control(ControlActions actions, std::vector<std::uint32_t> allowed)
    : actions_(std::move(actions)), allowed_(std::move(allowed)) {}

bool Control::allows(const protocol::Endpoint& from) const noexcept {
  return is_loopback(from) ||
         std::find(allowed_.begin(), allowed_.end(), from.address) != allowed_.end();
}

void Control::handle(const protocol::Message& message, const Arrived& arrived,
                     const protocol::SynthStatus& status, std::vector<Reply>& replies) {
  const protocol::Endpoint& from = arrived.from;
  if (message.address == "/ping" && !protocol::violation(message)) {
    if (!pongs_.allow(from.address, arrived.monotonic)) {
      ++withheld_;
      return;
    }
    replies.push_back({from, protocol::pong(std::get<protocol::TimeTag>(message.arguments[0]),
                                            protocol::to_time_tag(arrived.unix_time),
                                            protocol::to_time_tag(protocol::unix_now()))});
    return;
  }
  const auto reason = protocol::violation(message);
  protocol::Message reply =
      reason ? protocol::fail(message.address, *reason) : carry_out(message, from, status);
  if (limit_.allow(from.address, arrived.monotonic)) {
    replies.push_back({from, std::move(reply)});
  } else {
    ++withheld_;
  }
}

protocol::Message Control::carry_out(const protocol::Message& message,
                                     const protocol::Endpoint& from,
                                     const protocol::SynthStatus& status) {
  const std::string& address = message.address;
  if (address == "/status") return protocol::to_message(actions_.status(status));
  if (address == "/version") return protocol::version_reply(protocol::kSynthProgram);
  if (address == "/sync") return protocol::synced(integer(message));
  if (address == "/notify") return notify(message, from);
  if (address == "/quit") return quit(from);
  if (address == "/clearSched") {
    actions_.clear_scheduled();
  } else if (address == "/mute") {
    actions_.mute(integer(message) != 0);
  } else if (address == "/dumpOSC") {
    dump_level_ = integer(message);
  } else if (address == "/error") {
    reports_failures_ = integer(message) != 0;
  } else {
    return protocol::fail(address, "not a command of synth-server");
  }
  return protocol::done(address);
}

protocol::Message Control::notify(const protocol::Message& message,
                                  const protocol::Endpoint& from) {
  std::erase(clients_, from);
  if (integer(message) == 0) return protocol::done(message.address, 0);
  if (clients_.size() == kMostClients) {
    return protocol::fail(message.address,
                          "there are " + std::to_string(kMostClients) + " clients already");
  }
  clients_.push_back(from);
  return protocol::done(message.address, static_cast<std::int32_t>(clients_.size()));
}

protocol::Message Control::quit(const protocol::Endpoint& from) {
  if (!is_loopback(from)) return protocol::fail("/quit", "only from the synth's own host");
  actions_.quit();
  return protocol::done("/quit");
}

void Control::say_goodbye(std::vector<Reply>& replies) const {
  for (const auto& client : clients_) replies.push_back({client, protocol::done("/quit")});
}

}  // namespace splash::synth
