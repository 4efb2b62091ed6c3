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

/// To who asked with /notify, when the program ends.
protocol::Message goodbye() {
  return protocol::done("/quit");
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
  const auto reason = protocol::violation(message);
  if (message.address == "/ping" && !reason) {
    const auto pong = protocol::pong(std::get<protocol::TimeTag>(message.arguments[0]),
                                     protocol::to_time_tag(arrived.unix_time),
                                     protocol::to_time_tag(protocol::unix_now()));
    answer(message.address, pong, arrived, pongs_, replies);
    return;
  }
  const protocol::Message reply =
      reason ? protocol::fail(message.address, *reason) : carry_out(message, arrived, status);
  answer(message.address, reply, arrived, limit_, replies);
}

void Control::answer(const std::string& command, const protocol::Message& reply,
                     const Arrived& arrived, ReplyLimit& limit, std::vector<Reply>& replies) {
  auto fitting = arrived.budget.take(reply);
  if (!fitting) {
    complaint_ = protocol::to_string(arrived.from) + ' ' + arrived.budget.complaint(command, reply);
  }
  if (fitting && limit.allow(arrived.from.address, arrived.monotonic)) {
    replies.push_back({arrived.from, std::move(*fitting)});
  } else {
    ++withheld_;
  }
}

protocol::Message Control::carry_out(const protocol::Message& message, const Arrived& arrived,
                                     const protocol::SynthStatus& status) {
  const std::string& address = message.address;
  if (address == "/status") return protocol::to_message(actions_.status(status));
  if (address == "/version") return protocol::version_reply(protocol::kSynthProgram);
  if (address == "/sync") return protocol::synced(integer(message));
  if (address == "/notify") return notify(message, arrived);
  if (address == "/quit") return quit(arrived.from);
  if (address == "/set" || address == "/get" || address == "/preset") return change(message);
  if (address == "/tone") {
    const std::string reason = actions_.tone(integer(message));
    return reason.empty() ? protocol::done(address) : protocol::fail(address, reason);
  }
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

protocol::Message Control::change(const protocol::Message& message) {
  const std::string& name = std::get<std::string>(message.arguments[0]);
  if (message.address != "/get") {
    const auto number = static_cast<double>(std::get<float>(message.arguments[1]));
    const bool set = message.address == "/set";
    const std::string reason = set ? actions_.set(name, number) : actions_.preset(name, number);
    if (!reason.empty()) return protocol::fail(message.address, reason);
    if (!set) return protocol::done(message.address);
  }
  const std::optional<double> value = actions_.get(name);
  return value ? protocol::value_of(name, *value) : protocol::fail(message.address, "no such row");
}

// Who cannot be told that it is a client is none.
protocol::Message Control::notify(const protocol::Message& message, const Arrived& arrived) {
  if (integer(message) > 1) return protocol::fail(message.address, "the synth has stream 1 alone");
  std::erase(clients_, arrived.from);
  if (integer(message) == 0) return protocol::done(message.address, 0);
  if (clients_.size() == kMostClients) {
    return protocol::fail(message.address,
                          "there are " + std::to_string(kMostClients) + " clients already");
  }
  arrived.budget.owe(goodbye());
  auto reply = protocol::done(message.address, static_cast<std::int32_t>(clients_.size() + 1));
  if (arrived.budget.fits(reply)) clients_.push_back(arrived.from);
  return reply;
}

protocol::Message Control::quit(const protocol::Endpoint& from) {
  if (!is_loopback(from)) return protocol::fail("/quit", "only from the synth's own host");
  actions_.quit();
  return protocol::done("/quit");
}

void Control::tell_changes(std::vector<Reply>& replies) const {
  constexpr std::size_t kMostAtOnce = 64;  // the next time the rest
  if (clients_.empty()) return;
  for (const auto& [name, value] : actions_.changes(kMostAtOnce)) {
    for (const auto& client : clients_) {
      replies.push_back({client, protocol::value_of(name, value)});
    }
  }
}

void Control::say_goodbye(std::vector<Reply>& replies) const {
  for (const auto& client : clients_) replies.push_back({client, goodbye()});
}

}  // namespace splash::synth
