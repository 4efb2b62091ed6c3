// SPDX-License-Identifier: MIT
// The simulator's control port: poses and commands are taken on a thread of their own, so that a
// pose is stamped when it arrives and not when a step ends.
#pragma once

#include <atomic>
#include <cstdint>
#include <functional>
#include <mutex>
#include <optional>
#include <stop_token>
#include <string>
#include <thread>
#include <vector>

#include "protocol/control_port.hpp"
#include "protocol/limits.hpp"
#include "protocol/message.hpp"
#include "protocol/status.hpp"
#include "protocol/udp_socket.hpp"
#include "sim-server/send/targets.hpp"

namespace splash::sim {

struct ControlSettings {
  protocol::Endpoint listen{.address = INADDR_LOOPBACK, .port = protocol::kSimPort};
  /// Hosts whose commands are obeyed besides this one's (127.0.0.0/8), in host byte order.
  std::vector<std::uint32_t> allowed = {};
};

/// When a pose came, the time tag of its bundle, if that says when it was taken, and who sent it.
struct PoseMoment {
  double arrival = 0.0;             ///< monotonic [s]
  std::optional<double> sent = {};  ///< Unix time by the sender's clock [s]
  protocol::Endpoint from = {};
};

/// What the program does on request. All are called on the control's thread and must be quick. A
/// command whose action is empty is refused with /fail.
struct ControlActions {
  std::function<void(const protocol::BodyPose& pose, const PoseMoment& moment)> pose = {};
  /// A message that is no command: whether a tracker of the scene sends it.
  std::function<bool(const protocol::Message& message, const PoseMoment& moment)> track = {};
  /// Grabs a body or lets it go, for `from`. Returns the reason why it cannot; empty: it did.
  std::function<std::string(std::int32_t body, bool on, const protocol::Endpoint& from)> grab = {};
  std::function<void(bool)> pause = {};
  std::function<void()> reset = {};  ///< the scene
  /// Sets a live row of the scene. Returns the reason why it did not; empty: it did.
  std::function<std::string(const std::string& name, double value)> set = {};
  std::function<std::optional<double>(const std::string& name)> get = {};
  /// Goes over to a scene. Returns the reason why it does not; empty: it does.
  std::function<std::string(const std::string& name)> scene = {};
  /// Returns the reason why the scene has no forces; empty: it has, and /notify 2 is obeyed.
  std::function<std::string()> no_forces = {};
  /// Returns the program's numbers; what the control port refused is added to them.
  std::function<protocol::SimStatus()> status = {};
  std::function<void()> quit = {};
  std::function<void(const std::string& line)> print =
      {};  ///< for the lines of /dumpOSC and /error
};

struct ControlCounts : protocol::ControlCounts {
  std::uint64_t packets = 0;          ///< datagrams that came
  std::uint64_t poses = 0;            ///< poses passed on
  std::uint64_t malformed_poses = 0;  ///< poses of other types or out of range
  std::uint64_t no_rotations = 0;     ///< poses whose quaternion is no unit
  std::uint64_t dropped = 0;          ///< by the kernel, its buffer full
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
  /// The number of times that the thread has waited for a datagram, ten a second at least.
  [[nodiscard]] std::uint64_t turns() const noexcept { return turns_; }

 private:
  using Outcome = protocol::Outcome;
  using Message = protocol::Message;
  using Visit = protocol::Visit;

  void listen(const std::stop_token& stop);
  /// Takes one datagram. Returns the replies that it draws.
  [[nodiscard]] std::vector<protocol::Reply> take(protocol::Bytes packet,
                                                  const protocol::UdpSocket::Received& received);
  void add_commands();
  [[nodiscard]] Outcome body_pose(const Message& message, const Visit& visit);
  [[nodiscard]] Outcome body_grab(const Message& message, const Visit& visit) const;
  [[nodiscard]] Outcome tile_pressure(const Message& message, const Visit& visit) const;
  [[nodiscard]] Outcome status() const;
  [[nodiscard]] Outcome notify(const Message& message, const Visit& visit) const;
  [[nodiscard]] Outcome pause(const Message& message) const;
  [[nodiscard]] Outcome reset(const Message& message) const;

  [[nodiscard]] Outcome param(const Message& message) const;
  [[nodiscard]] Outcome scene(const Message& message) const;

  ControlActions actions_;
  Targets& targets_;
  protocol::UdpSocket socket_;
  double arrival_ = 0.0;  ///< of the last datagram, monotonic [s]
  std::atomic<std::uint64_t> turns_{0};
  mutable std::mutex mutex_;  ///< guards the two below
  protocol::ControlPort port_;
  ControlCounts counts_;  ///< but for the port's own
  std::jthread thread_;   ///< last: it uses all of the above
};

}  // namespace splash::sim
