// SPDX-License-Identifier: MIT
// A bad network between two real programs: what comes for the one is passed on, and what it answers
// goes back, but for a share of the datagrams.
#pragma once

#include <atomic>
#include <cstdint>
#include <random>
#include <thread>
#include <vector>

#include "protocol/udp_socket.hpp"

namespace splash::tests {

class LossyRelay {
 public:
  /// `loss`: share of the datagrams in either direction that never arrive [1].
  LossyRelay(const protocol::Endpoint& target, double loss, unsigned seed);

  /// Where to send what is for the target.
  [[nodiscard]] protocol::Endpoint local() const noexcept { return front_.local(); }
  /// Datagrams for the target that did not arrive.
  [[nodiscard]] std::uint64_t lost() const noexcept { return lost_; }

 private:
  /// Who has sent something, and the socket that speaks for it to the target.
  struct Line {
    protocol::Endpoint peer;
    protocol::UdpSocket socket;
  };

  void run(const std::stop_token& stop);
  void pass_on();
  void pass_back(Line& line);
  [[nodiscard]] Line& line_of(const protocol::Endpoint& peer);

  protocol::Endpoint target_;
  std::bernoulli_distribution loses_;
  std::mt19937 random_;
  std::atomic<std::uint64_t> lost_ = 0;
  protocol::UdpSocket front_;
  std::vector<Line> lines_;
  std::jthread thread_;
};

}  // namespace splash::tests
