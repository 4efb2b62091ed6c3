// SPDX-License-Identifier: MIT
// The simulator's end of a link: its real EventSender on the test's clock, its datagrams caught
// where they leave.
#pragma once

#include <functional>
#include <vector>

#include "protocol/udp_socket.hpp"
#include "sim-server/send/event_sender.hpp"
#include "sim-server/send/targets.hpp"
#include "tests/network/impaired_link.hpp"

namespace splash::network {

class SimSide {
 public:
  /// `unix_clock`: the simulator's host's [s].
  explicit SimSide(std::function<double()> unix_clock);

  /// What the simulator says at the end of the frame at `seconds`: these events, or a heartbeat
  /// when it is time for one.
  [[nodiscard]] std::vector<Datagram> say(double seconds, std::vector<sim::TimedEvent> events);
  /// Answers a /ping of the synth with the host's clock, as the simulator's ClockAnswers does.
  [[nodiscard]] protocol::Message answer(const protocol::Message& ping) const;

 private:
  std::function<double()> unix_clock_;
  protocol::UdpSocket here_{protocol::Endpoint{}};
  protocol::UdpSocket caught_{protocol::Endpoint{}};
  sim::Targets targets_;
  sim::EventSender sender_;
  std::int64_t step_ = 0;
};

}  // namespace splash::network
