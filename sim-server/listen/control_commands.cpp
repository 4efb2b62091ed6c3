// SPDX-License-Identifier: MIT
// What each control command does. Their types, ranges and meanings are the address table's.
#include <algorithm>
#include <array>
#include <numeric>
#include <string>
#include <variant>
#include <vector>

#include "program/nearest_name.hpp"
#include "protocol/address.hpp"
#include "protocol/control.hpp"
#include "protocol/time_tag.hpp"
#include "sim-server/listen/control.hpp"
#include "sim-server/send/lo_packet.hpp"

namespace splash::sim {
namespace {

/// The first argument of a message that keeps its row of the address table.
std::int32_t first_int(const protocol::Message& message) {
  return std::get<std::int32_t>(message.arguments.front());
}

}  // namespace

struct ControlServer::Command {
  const char* address;
  void (ControlServer::*run)(const Request&);

  static const std::array<Command, 14>& all() {
    static constexpr std::array<Command, 14> kCommands = {{
        {"/body/pose", &ControlServer::body_pose},
        {"/body/grab", &ControlServer::body_grab},
        {"/tile/pressure", &ControlServer::tile_pressure},
        {"/status", &ControlServer::status},
        {"/version", &ControlServer::version},
        {"/sync", &ControlServer::sync},
        {"/notify", &ControlServer::notify},
        {"/dumpOSC", &ControlServer::dump_osc},
        {"/error", &ControlServer::error},
        {"/clearSched", &ControlServer::clear_sched},
        {"/pause", &ControlServer::pause},
        {"/reset", &ControlServer::reset},
        {"/quit", &ControlServer::quit},
        {"/ping", &ControlServer::ping},
    }};
    return kCommands;
  }

  /// "unknown command, did you mean /status?"
  static std::string unknown(const std::string& address) {
    std::vector<std::string> known;
    for (const auto& command : all()) known.emplace_back(command.address);
    const auto nearest = program::nearest_name(address, known);
    return nearest.empty() ? "unknown command" : "unknown command, did you mean " + nearest + "?";
  }
};

void ControlServer::run(const Request& request) {
  const auto& address = request.message.address;
  const auto& commands = Command::all();
  const auto command = std::find_if(commands.begin(), commands.end(),
                                    [&](const Command& row) { return row.address == address; });
  if (command == commands.end()) {
    // Answering replies and events would let two programs answer each other for ever.
    if (protocol::find_address(address) != nullptr) {
      count(&ControlCounts::unasked);
    } else if (!actions_.track ||
               !actions_.track(request.message, {request.monotonic, request.sent})) {
      fail(request, Command::unknown(address));
    }
  } else if (const auto reason = protocol::violation(request.message)) {
    if (command->run == &ControlServer::body_pose) count(&ControlCounts::malformed_poses);
    fail(request, *reason);
  } else {
    (this->*command->run)(request);
  }
}

void ControlServer::reply(const Request& request, const protocol::Message& message) {
  const auto fitting = request.budget.take(message);
  if (!fitting) {
    complain(request.from, request.budget.complaint(request.message.address, message));
  }
  if (!fitting || !replies_.allow(request.from, request.monotonic)) {
    count(&ControlCounts::withheld);
    return;
  }
  if (socket_.send_to(request.from, build_message(*fitting))) count(&ControlCounts::replies);
}

void ControlServer::fail(const Request& request, const std::string& reason) {
  count(&ControlCounts::failed);
  complain(request.from, request.message.address + ": " + reason);
  reply(request, protocol::fail(request.message.address, reason));
}

void ControlServer::body_pose(const Request& request) {
  if (const auto* name = std::get_if<std::string>(&request.message.arguments.front())) {
    if (actions_.track && actions_.track(request.message, {request.monotonic, request.sent})) {
      count(&ControlCounts::poses);
    } else {
      fail(request, "no body named '" + *name + "' is moved over OSC");
    }
    return;
  }
  const auto pose = protocol::to_body_pose(request.message);
  if (!pose) {
    count(&ControlCounts::no_rotations);
    fail(request, "the quaternion's length is not 1 within 10 %");
  } else if (!actions_.pose) {
    fail(request, "no body of this scene is moved over OSC");
  } else {
    actions_.pose(*pose, {request.monotonic, request.sent});
    count(&ControlCounts::poses);
  }
}

void ControlServer::tile_pressure(const Request& request) {
  if (actions_.track && actions_.track(request.message, {request.monotonic, request.sent})) return;
  fail(request, "no body of this scene has motion: {kind: pressure}");
}

void ControlServer::body_grab(const Request& request) {
  const bool on = std::get<std::int32_t>(request.message.arguments[1]) != 0;
  const std::string reason =
      actions_.grab ? actions_.grab(first_int(request.message), on) : "no body can be grabbed";
  if (reason.empty()) {
    reply(request, protocol::done(request.message.address));
  } else {
    fail(request, reason);
  }
}

void ControlServer::status(const Request& request) {
  if (!actions_.status) {
    fail(request, "no status yet");
    return;
  }
  auto status = actions_.status();
  const auto seen = counts();
  status.refused += std::accumulate(seen.refused.begin(), seen.refused.end(), seen.failed);
  reply(request, protocol::to_message(status));
}

void ControlServer::version(const Request& request) {
  reply(request, protocol::version_reply(protocol::kSimProgram));
}

/// Commands are obeyed in their order before the next one is looked at: nothing is left to wait
/// for.
void ControlServer::sync(const Request& request) {
  reply(request, protocol::synced(first_int(request.message)));
}

void ControlServer::notify(const Request& request) {
  const auto streams = first_int(request.message);
  if ((static_cast<unsigned>(streams) & kForceStream) != 0) {
    const std::string reason = actions_.no_forces ? actions_.no_forces() : "no forces here";
    if (!reason.empty()) {
      fail(request, reason);
      return;
    }
  }
  if (streams == 0) {
    targets_.unsubscribe(request.from);
  } else if (!targets_.subscribe(request.from, static_cast<unsigned>(streams))) {
    fail(request, "full: " + std::to_string(kMaxSubscribers) + " subscribers");
    return;
  }
  reply(request, protocol::done("/notify", streams));
}

void ControlServer::dump_osc(const Request& request) {
  dump_level_ = static_cast<DumpLevel>(first_int(request.message));
  reply(request, protocol::done(request.message.address));
}

void ControlServer::error(const Request& request) {
  complains_ = first_int(request.message) != 0;
  reply(request, protocol::done(request.message.address));
}

/// Poses are taken at once and events are the synth's to hold: nothing is scheduled here.
void ControlServer::clear_sched(const Request& request) {
  reply(request, protocol::done("/clearSched"));
}

void ControlServer::pause(const Request& request) {
  if (!actions_.pause) {
    fail(request, "this program does not pause");
    return;
  }
  const std::int32_t on = first_int(request.message);
  actions_.pause(on != 0);
  reply(request, protocol::done("/pause", on));
}

void ControlServer::reset(const Request& request) {
  if (!actions_.reset) {
    fail(request, "this program has no scene to begin anew");
    return;
  }
  actions_.reset();
  reply(request, protocol::done("/reset"));
}

void ControlServer::quit(const Request& request) {
  if (!is_loopback(request.from)) {
    fail(request, "only from the simulator's own host");
  } else if (!actions_.quit) {
    fail(request, "this program does not end on request");
  } else {
    reply(request, protocol::done("/quit"));
    actions_.quit();
  }
}

void ControlServer::ping(const Request& request) {
  const auto sent = std::get<protocol::TimeTag>(request.message.arguments.front());
  reply(request, protocol::pong(sent, protocol::to_time_tag(request.unix_time),
                                protocol::to_time_tag(protocol::unix_now())));
}

}  // namespace splash::sim
