// SPDX-License-Identifier: MIT
// Answers the /ping with which receivers measure the simulator's clock. They send it to the port
// that their events come from. A thread of its own answers, since waiting for a frame to be
// computed would look like travel time.
#pragma once

#include <atomic>
#include <cstdint>
#include <functional>
#include <stop_token>
#include <string>
#include <thread>

#include "protocol/limits.hpp"
#include "protocol/reply_budget.hpp"
#include "protocol/udp_socket.hpp"
#include "sim-server/send/targets.hpp"

namespace splash::sim {

class ClockAnswers {
 public:
  using Print = std::function<void(const std::string& line)>;

  /// Reads `socket`, from which another thread sends the events. Only /ping is answered, and only
  /// hosts of `targets` are. Both outlive this object. `print` is called on its thread when a /ping
  /// was too short for its /pong (protocol::ReplyBudget).
  ClockAnswers(protocol::UdpSocket& socket, const Targets& targets, Print print);
  ~ClockAnswers() = default;  ///< stops within a tenth of a second
  ClockAnswers(const ClockAnswers&) = delete;
  ClockAnswers& operator=(const ClockAnswers&) = delete;

  [[nodiscard]] std::uint64_t answered() const noexcept { return answered_; }
  /// The number of pings that were too short for their /pong.
  [[nodiscard]] std::uint64_t withheld() const noexcept { return withheld_; }

 private:
  void listen(const std::stop_token& stop);
  void take(protocol::Bytes packet, const protocol::Endpoint& from);
  void withhold(const protocol::Endpoint& from, const std::string& why);
  [[nodiscard]] bool is_target(const protocol::Endpoint& from) const;

  protocol::UdpSocket& socket_;
  const Targets& targets_;
  Print print_;
  protocol::RateLimit replies_{protocol::kPongRate, protocol::kPongBurst};
  protocol::RateLimit reports_{protocol::kReportRate, protocol::kReportBurst};
  std::atomic<std::uint64_t> answered_ = 0;
  std::atomic<std::uint64_t> withheld_ = 0;
  std::jthread thread_;  ///< last: it uses all of the above
};

}  // namespace splash::sim
