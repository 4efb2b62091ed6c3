// SPDX-License-Identifier: MIT
// What the simulator's own commands do. Their types, ranges and meanings are the address table's;
// protocol::ControlPort carries out those that both programs have alike.
#include <numeric>
#include <string>
#include <variant>

#include "protocol/control.hpp"
#include "protocol/time_tag.hpp"
#include "sim-server/listen/control.hpp"

namespace splash::sim {
namespace {

/// An argument of a message that conforms to its row of the address table.
std::int32_t integer(const protocol::Message& message, std::size_t index = 0) {
  return std::get<std::int32_t>(message.arguments[index]);
}

/// "At once" and nothing at all, as some libraries write it, are no moments.
PoseMoment moment_of(const protocol::Visit& visit) {
  PoseMoment moment{.arrival = visit.arrival, .from = visit.from};
  if (visit.sent && visit.sent->value > protocol::kImmediately.value) {
    moment.sent = protocol::to_unix_seconds(*visit.sent);
  }
  return moment;
}

}  // namespace

void ControlServer::add_commands() {
  port_.on("/body/pose", [this](const Message& message, const Visit& visit) {
    return body_pose(message, visit);
  });
  port_.on("/body/grab", [this](const Message& message, const Visit& visit) {
    return body_grab(message, visit);
  });
  port_.on("/tile/pressure", [this](const Message& message, const Visit& visit) {
    return tile_pressure(message, visit);
  });
  port_.on("/status", [this](const Message&, const Visit&) { return status(); });
  port_.on("/notify",
           [this](const Message& message, const Visit& visit) { return notify(message, visit); });
  // Poses are taken at once and events are the synth's to hold: nothing is scheduled here.
  port_.on("/clearSched",
           [](const Message& message, const Visit&) { return protocol::done_unless({}, message); });
  port_.on("/pause", [this](const Message& message, const Visit&) { return pause(message); });
  port_.on("/reset", [this](const Message& message, const Visit&) { return reset(message); });
  port_.on("/param", [this](const Message& message, const Visit&) { return param(message); });
  port_.on("/scene", [this](const Message& message, const Visit&) { return scene(message); });
  port_.on_others([this](const Message& message, const Visit& visit) {
    return actions_.track && actions_.track(message, moment_of(visit));
  });
}

protocol::Outcome ControlServer::body_pose(const Message& message, const Visit& visit) {
  const PoseMoment moment = moment_of(visit);
  if (const auto* name = std::get_if<std::string>(&message.arguments.front())) {
    if (!actions_.track || !actions_.track(message, moment)) {
      return {.refused = "no body named '" + *name + "' is moved over OSC"};
    }
  } else {
    const auto pose = protocol::conforming_pose(message);
    if (!pose) {
      ++counts_.no_rotations;
      return {.refused = "the quaternion's length is not 1 within 10 %"};
    }
    if (!actions_.pose) return {.refused = "no body of this scene is moved over OSC"};
    actions_.pose(*pose, moment);
  }
  ++counts_.poses;
  return {};
}

protocol::Outcome ControlServer::tile_pressure(const Message& message, const Visit& visit) const {
  if (actions_.track && actions_.track(message, moment_of(visit))) return {};
  return {.refused = "no body of this scene has motion: {kind: pressure}"};
}

protocol::Outcome ControlServer::body_grab(const Message& message, const Visit& visit) const {
  if (!actions_.grab) return {.refused = "no body can be grabbed"};
  return protocol::done_unless(
      actions_.grab(integer(message), integer(message, 1) != 0, visit.from), message);
}

protocol::Outcome ControlServer::status() const {
  if (!actions_.status) return {.refused = "no status yet"};
  auto status = actions_.status();
  const protocol::ControlCounts& seen = port_.counts();
  status.refused += std::accumulate(seen.refused.begin(), seen.refused.end(),
                                    seen.out_of_table + counts_.no_rotations);
  return {.reply = protocol::to_message(status)};
}

protocol::Outcome ControlServer::notify(const Message& message, const Visit& visit) const {
  const auto streams = static_cast<unsigned>(integer(message));
  if ((streams & kForceStream) != 0) {
    const std::string reason = actions_.no_forces ? actions_.no_forces() : "no forces here";
    if (!reason.empty()) return {.refused = reason};
  }
  if (streams == 0) {
    targets_.unsubscribe(visit.from);
  } else if (!targets_.subscribe(visit.from, streams)) {
    return {.refused = protocol::too_many_subscribers()};
  }
  return {.reply = protocol::done(message.address, integer(message))};
}

protocol::Outcome ControlServer::pause(const Message& message) const {
  if (!actions_.pause) return {.refused = "this program does not pause"};
  actions_.pause(integer(message) != 0);
  return {.reply = protocol::done(message.address, integer(message))};
}

protocol::Outcome ControlServer::reset(const Message& message) const {
  if (!actions_.reset) return {.refused = "this program has no scene to begin anew"};
  actions_.reset();
  return protocol::done_unless({}, message);
}

protocol::Outcome ControlServer::param(const Message& message) const {
  if (!actions_.set || !actions_.get) {
    return {.refused = "this program has no scene whose rows can change"};
  }
  const auto& name = std::get<std::string>(message.arguments.front());
  const float* value =
      message.arguments.size() > 1 ? std::get_if<float>(&message.arguments[1]) : nullptr;
  if (value != nullptr) {
    std::string refused = actions_.set(name, static_cast<double>(*value));
    if (!refused.empty()) return {.refused = std::move(refused)};
  }
  const std::optional<double> now = actions_.get(name);
  if (!now) return {.refused = "no live row of the scene is called so"};
  return {.reply = protocol::value_of(name, *now)};
}

protocol::Outcome ControlServer::scene(const Message& message) const {
  if (!actions_.scene) return {.refused = "this program keeps its scene"};
  return protocol::done_unless(actions_.scene(std::get<std::string>(message.arguments.front())),
                               message);
}

}  // namespace splash::sim
