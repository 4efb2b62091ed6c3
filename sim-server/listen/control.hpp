// SPDX-License-Identifier: MIT
// The simulator's ear: poses and control, gated, answered, counted, on a thread of its own so that
// a pose is stamped when it arrives and not when a step ends.
#pragma once

#include <array>
#include <atomic>
#include <cstdint>
#include <functional>
#include <mutex>
#include <optional>
#include <stop_token>
#include <string>
#include <thread>
#include <vector>

#include "program/text_limit.hpp"
#include "protocol/gate.hpp"
#include "protocol/limits.hpp"
#include "protocol/message.hpp"
#include "protocol/reply_budget.hpp"
#include "protocol/status.hpp"
#include "protocol/udp_socket.hpp"
#include "sim-server/listen/dump.hpp"
#include "sim-server/listen/rate_limit.hpp"
#include "sim-server/send/targets.hpp"

namespace splash::sim {

struct ControlSettings {
  protocol::Endpoint listen{.address = INADDR_LOOPBACK, .port = protocol::kSimPort};
  /// Hosts that are heard besides this one (127.0.0.0/8), in host byte order.
  std::vector<std::uint32_t> allowed = {};
};

/// When a pose came, and the time tag of its bundle, if that says when it was taken.
struct PoseMoment {
  double arrival = 0.0;             ///< monotonic [s]
  std::optional<double> sent = {};  ///< Unix time by the sender's clock [s]
};

/// What the program does on request. All are called on the control's thread, `pose` for each pose
/// as it arrives; they must be quick. Empty ones are refused with /fail.
struct ControlActions {
  std::function<void(const protocol::BodyPose& pose, const PoseMoment& moment)> pose = {};
  /// A message that is no command: whether a tracker of the scene sends it.
  std::function<bool(const protocol::Message& message, const PoseMoment& moment)> track = {};
  /// Grabs a body or lets it go; why it cannot, or nothing.
  std::function<std::string(std::int32_t body, bool on)> grab = {};
  std::function<void(bool)> pause = {};
  std::function<void()> reset = {};  ///< the scene
  /// Why nobody can be sent forces; empty: /notify 2 is obeyed.
  std::function<std::string()> no_forces = {};
  /// The program's numbers; the refused datagrams and messages are added here.
  std::function<protocol::SimStatus()> status = {};
  std::function<void()> quit = {};
  std::function<void(const std::string& line)> print = {};  ///< /dumpOSC and /error write here
};

struct ControlCounts {
  std::uint64_t packets = 0;      ///< datagrams that came
  std::uint64_t poses = 0;        ///< poses passed on
  std::uint64_t replies = 0;      ///< sent
  std::uint64_t not_allowed = 0;  ///< from a host that is not heard; never answered
  std::array<std::uint64_t, static_cast<std::size_t>(protocol::Refusal::count_)> refused = {};
  std::uint64_t malformed_poses = 0;  ///< poses of other types or out of range; part of `failed`
  std::uint64_t no_rotations = 0;     ///< poses whose quaternion is no unit; part of `failed`
  std::uint64_t failed = 0;           ///< messages that were not obeyed; answered by /fail
  std::uint64_t unasked = 0;          ///< replies and events, which the simulator has no use for
  /// Replies over the limit (RateLimit) or longer than their question (protocol::ReplyBudget).
  std::uint64_t withheld = 0;
  std::uint64_t dropped = 0;  ///< by the kernel, its buffer full
};

class ControlServer {
 public:
  /// Binds and starts to listen. Throws std::runtime_error when the port cannot be had.
  ControlServer(const ControlSettings& settings, ControlActions actions, Targets& targets);
  ~ControlServer() = default;  ///< stops within a tenth of a second
  ControlServer(const ControlServer&) = delete;
  ControlServer& operator=(const ControlServer&) = delete;

  [[nodiscard]] protocol::Endpoint local() const noexcept { return socket_.local(); }
  [[nodiscard]] ControlCounts counts() const;
  /// How often the listening thread has looked, ten times a second at least.
  [[nodiscard]] std::uint64_t turns() const noexcept { return turns_; }

 private:
  struct Request {
    const protocol::Message& message;
    protocol::Endpoint from;
    double monotonic = 0.0;      ///< of arrival [s]
    double unix_time = 0.0;      ///< of arrival [s]
    std::optional<double> sent;  ///< time tag of its bundle, Unix time [s]
    protocol::ReplyBudget& budget;
  };
  struct Command;  ///< an address and what it does, see control_commands.cpp

  void listen(const std::stop_token& stop);
  void take(protocol::Bytes packet, const protocol::UdpSocket::Received& received);
  void dump(const std::string& line, double now);
  void refuse(protocol::Refusal refusal, const protocol::Endpoint& from);
  void obey(const Request& request);
  void run(const Request& request);
  [[nodiscard]] bool is_allowed(const protocol::Endpoint& from) const;
  void reply(const Request& request, const protocol::Message& message);
  void fail(const Request& request, const std::string& reason);
  void complain(const protocol::Endpoint& from, const std::string& text);
  void count(std::uint64_t ControlCounts::*counter);

  void body_pose(const Request& request);
  void tile_pressure(const Request& request);
  void body_grab(const Request& request);
  void status(const Request& request);
  void version(const Request& request);
  void sync(const Request& request);
  void notify(const Request& request);
  void dump_osc(const Request& request);
  void error(const Request& request);
  void clear_sched(const Request& request);
  void pause(const Request& request);
  void reset(const Request& request);
  void quit(const Request& request);
  void ping(const Request& request);

  ControlSettings settings_;
  ControlActions actions_;
  Targets& targets_;
  protocol::UdpSocket socket_;
  RateLimit replies_;
  RateLimit complaints_;
  DumpLevel dump_level_ = DumpLevel::off;
  program::TextLimit dumped_;
  bool complains_ = true;  ///< /error 1
  double arrival_ = 0.0;   ///< of the last datagram, monotonic [s]
  std::atomic<std::uint64_t> turns_{0};
  mutable std::mutex mutex_;
  ControlCounts counts_;  ///< under mutex_
  std::jthread thread_;   ///< last: it uses all of the above
};

}  // namespace splash::sim
