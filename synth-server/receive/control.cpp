// SPDX-License-Identifier: MIT
#include "synth-server/receive/control.hpp"

#include <algorithm>
#include <utility>

#include "protocol/control.hpp"

namespace splash::synth {
namespace {

using protocol::Message;
using protocol::Outcome;
using protocol::Visit;

/// Arguments of a message that conforms to its row of the address table.
std::int32_t integer(const Message& message) {
  return std::get<std::int32_t>(message.arguments.front());
}
const std::string& name_in(const Message& message) {
  return std::get<std::string>(message.arguments[0]);
}
double number_in(const Message& message) {
  return static_cast<double>(std::get<float>(message.arguments[1]));
}

/// To who asked with /notify, when the program ends.
Message goodbye() {
  return protocol::done("/quit");
}

constexpr const char* kNothingPlays = "nothing plays here";

}  // namespace

Control::Control(ControlActions actions, std::vector<std::uint32_t> allowed,
                 std::function<protocol::SynthStatus()> heard)
    : actions_(std::move(actions)),
      heard_(std::move(heard)),
      port_({.program = protocol::kSynthProgram,
             .allowed = std::move(allowed),
             .print = actions_.print},
            actions_.quit) {
  add_commands();
}

void Control::add_commands() {
  port_.on("/status", [this](const Message&, const Visit&) {
    const protocol::SynthStatus status = heard_();
    return Outcome{.reply =
                       protocol::to_message(actions_.status ? actions_.status(status) : status)};
  });
  port_.on("/notify",
           [this](const Message& message, Visit& visit) { return notify(message, visit); });
  port_.on("/clearSched", [this](const Message& message, const Visit&) {
    if (!actions_.clear_scheduled) return Outcome{.refused = kNothingPlays};
    actions_.clear_scheduled();
    return protocol::done_unless({}, message);
  });
  port_.on("/mute", [this](const Message& message, const Visit&) {
    if (!actions_.mute) return Outcome{.refused = kNothingPlays};
    actions_.mute(integer(message) != 0);
    return protocol::done_unless({}, message);
  });
  port_.on("/tone", [this](const Message& message, const Visit&) {
    return protocol::done_unless(actions_.tone ? actions_.tone(integer(message)) : kNothingPlays,
                                 message);
  });
  port_.on("/rig", [this](const Message& message, const Visit&) { return rig(message); });
  port_.on("/preset", [this](const Message& message, const Visit&) {
    return protocol::done_unless(
        actions_.preset ? actions_.preset(name_in(message), number_in(message)) : kNothingPlays,
        message);
  });
  port_.on("/set", [this](const Message& message, const Visit&) {
    const std::string refused =
        actions_.set ? actions_.set(name_in(message), number_in(message)) : kNothingPlays;
    return refused.empty() ? value_of(message) : Outcome{.refused = refused};
  });
  port_.on("/get", [this](const Message& message, const Visit&) { return value_of(message); });
}

Outcome Control::rig(const Message& message) const {
  if (!actions_.rig) return {.refused = "this program keeps its rig"};
  const auto& arguments = message.arguments;
  std::optional<std::array<double, 3>> middle;
  if (arguments.size() > 3 && std::holds_alternative<float>(arguments[1])) {
    middle.emplace();
    for (std::size_t axis = 0; axis < 3; ++axis) {
      (*middle)[axis] = static_cast<double>(std::get<float>(arguments[axis + 1]));
    }
  }
  return protocol::done_unless(actions_.rig(name_in(message), middle), message);
}

Outcome Control::value_of(const Message& message) const {
  const std::string& name = name_in(message);
  const std::optional<double> value = actions_.get ? actions_.get(name) : std::nullopt;
  if (!value) return {.refused = "no such row"};
  return {.reply = protocol::value_of(name, *value)};
}

// Who cannot be told that it has subscribed has not: the goodbye would be more than was asked for.
Outcome Control::notify(const Message& message, Visit& visit) {
  const std::int32_t streams = integer(message);
  if (streams > 1) return {.refused = "the synth has stream 1 alone"};
  const auto known = std::find_if(subscribers_.begin(), subscribers_.end(),
                                  [&](const Subscriber& s) { return s.endpoint == visit.from; });
  const bool is_new = known == subscribers_.end();
  Outcome done = {.reply = protocol::done(message.address, streams)};
  if (streams == 0) {
    if (!is_new) subscribers_.erase(known);
    return done;
  }
  if (!is_new) return done;
  if (subscribers_.size() == protocol::kMaxSubscribers) {
    return {.refused = protocol::too_many_subscribers()};
  }
  visit.budget.owe(goodbye());
  if (visit.budget.fits(*done.reply)) {
    subscribers_.push_back({visit.from, visit.arrival + protocol::kSubscriptionLease});
  }
  return done;
}

void Control::renew(const protocol::Endpoint& from, double now) {
  for (Subscriber& subscriber : subscribers_) {
    if (subscriber.endpoint == from) subscriber.expires = now + protocol::kSubscriptionLease;
  }
}

void Control::expire(double now) {
  std::erase_if(subscribers_, [now](const Subscriber& s) { return s.expires < now; });
}

void Control::tell_changes(std::vector<Reply>& replies) const {
  constexpr std::size_t kMostAtOnce = 64;  // the next time the rest
  if (subscribers_.empty() || !actions_.changes) return;
  for (const auto& [name, value] : actions_.changes(kMostAtOnce)) {
    for (const auto& [endpoint, expires] : subscribers_) {
      replies.push_back({endpoint, protocol::value_of(name, value)});
    }
  }
}

void Control::say_goodbye(std::vector<Reply>& replies) const {
  for (const auto& [endpoint, expires] : subscribers_) replies.push_back({endpoint, goodbye()});
}

}  // namespace splash::synth
