// SPDX-License-Identifier: MIT
// Receivers measure the simulator's clock by a /ping to where their events come from: answered
// here, on a thread of its own, since a frame's computing would be taken for travelling.
#pragma once

#include <atomic>
#include <cstdint>
#include <stop_token>
#include <thread>

#include "protocol/udp_socket.hpp"
#include "sim-server/send/rate_limit.hpp"
#include "sim-server/send/targets.hpp"

namespace splash::sim {

class ClockAnswers {
 public:
  /// Reads `socket`, from which another thread sends the events. Only hosts of `targets` are
  /// answered, and only /ping. Both outlive this.
  ClockAnswers(protocol::UdpSocket& socket, const Targets& targets);
  ~ClockAnswers() = default;  ///< stops within a tenth of a second
  ClockAnswers(const ClockAnswers&) = delete;
  ClockAnswers& operator=(const ClockAnswers&) = delete;

  [[nodiscard]] std::uint64_t answered() const noexcept { return answered_; }

 private:
  void listen(const std::stop_token& stop);
  void take(protocol::Bytes packet, const protocol::Endpoint& from);
  [[nodiscard]] bool is_target(const protocol::Endpoint& from) const;

  protocol::UdpSocket& socket_;
  const Targets& targets_;
  RateLimit replies_;
  std::atomic<std::uint64_t> answered_ = 0;
  std::jthread thread_;  ///< last: it uses all of the above
};

}  // namespace splash::sim
