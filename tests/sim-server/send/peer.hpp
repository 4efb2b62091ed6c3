// SPDX-License-Identifier: MIT
// The other end of a wire in a test: a socket on a free port.
#pragma once

#include <gtest/gtest.h>

#include <array>
#include <cstddef>
#include <optional>
#include <span>
#include <vector>

#include "protocol/message.hpp"
#include "protocol/udp_socket.hpp"

namespace splash::test {

inline constexpr double kTimeout = 5.0;  ///< for what must come; a pass never waits as long [s]

class Peer {
 public:
  explicit Peer(std::uint32_t address = INADDR_LOOPBACK)
      : socket_({.address = address, .port = 0}) {}

  [[nodiscard]] protocol::Endpoint endpoint() const { return socket_.local(); }

  void send(const protocol::Endpoint& to, const protocol::Message& message) {
    send(to, protocol::encode(message));
  }
  void send(const protocol::Endpoint& to, const std::vector<std::byte>& bytes) {
    EXPECT_TRUE(socket_.send_to(to, bytes));
  }

  [[nodiscard]] std::optional<std::vector<std::byte>> bytes(double timeout = kTimeout) {
    std::array<std::byte, 2048> buffer{};
    const auto received = socket_.receive(buffer.data(), buffer.size(), timeout);
    if (!received) return std::nullopt;
    from_ = received->from;
    return std::vector<std::byte>(buffer.begin(),
                                  buffer.begin() + static_cast<std::ptrdiff_t>(received->size));
  }
  /// The next datagram, which must pass the gate.
  [[nodiscard]] std::optional<protocol::Packet> packet(double timeout = kTimeout) {
    const auto raw = bytes(timeout);
    if (!raw) return std::nullopt;
    auto decoded = protocol::decode(*raw);
    EXPECT_EQ(decoded.refusal, protocol::Refusal::none) << protocol::describe(decoded.refusal);
    return decoded.packet;
  }
  /// The next datagram's first message; an empty one when none came.
  [[nodiscard]] protocol::Message message(double timeout = kTimeout) {
    const auto next = packet(timeout);
    if (!next || next->messages.empty()) return {};
    return next->messages.front();
  }
  /// Nothing has come. Loopback delivers before the sender's call returns.
  [[nodiscard]] bool silent() { return !bytes(0.0).has_value(); }
  [[nodiscard]] protocol::Endpoint last_sender() const { return from_; }

 private:
  protocol::UdpSocket socket_;
  protocol::Endpoint from_;
};

}  // namespace splash::test
