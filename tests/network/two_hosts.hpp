// SPDX-License-Identifier: MIT
// Two hosts on one machine: network namespaces of their own, joined by a virtual cable. Needs the
// rights of an administrator and the program `ip`; says so where it has not.
#pragma once

#include <cstdint>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "protocol/udp_socket.hpp"

namespace splash::network {

class TwoHosts {
 public:
  /// nullopt in its place when they cannot be had; why() then says what is missing.
  TwoHosts();
  ~TwoHosts();
  TwoHosts(const TwoHosts&) = delete;
  TwoHosts& operator=(const TwoHosts&) = delete;

  /// Empty: both are there.
  [[nodiscard]] const std::string& why_not() const { return why_not_; }

  /// 0 or 1: the first has 10.77.0.1 and 10.77.0.3, the second 10.77.0.2.
  [[nodiscard]] std::vector<std::string> command_on(int host,
                                                    std::vector<std::string> command) const;
  /// A socket that sends and listens there.
  [[nodiscard]] protocol::UdpSocket socket_on(int host, const std::string& endpoint) const;
  /// Sends `payload` from there with any address, which may be another host's, as its sender's.
  void send_forged(int host, const protocol::Endpoint& sender, const protocol::Endpoint& to,
                   protocol::Bytes payload) const;
  /// Datagrams and whatever else came there over the cable so far.
  [[nodiscard]] std::uint64_t received_on(int host) const;
  /// What listens there on UDP, as /proc/net/udp has it: "0100007F:DFF3".
  [[nodiscard]] std::vector<std::string> listening_on(int host) const;

 private:
  [[nodiscard]] std::string name(int host) const;
  std::string why_not_;
};

}  // namespace splash::network
