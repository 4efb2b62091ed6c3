// SPDX-License-Identifier: MIT
// What one datagram may draw in replies: together never more bytes than it had, since the address
// of a UDP sender may be forged and our replies would then go to somebody who never asked.
#pragma once

#include <cstddef>
#include <optional>
#include <string>

#include "protocol/message.hpp"
#include "protocol/udp_socket.hpp"

namespace splash::protocol {

class ReplyBudget {
 public:
  /// `bytes`: of the datagram that came from `asker`. A program's own host (127.0.0.0/8) has no
  /// limit: the kernel drops what comes from outside under such an address (RFC 1122, 3.2.1.3).
  ReplyBudget(const Endpoint& asker, std::size_t bytes) noexcept
      : limited_(!is_loopback(asker)), bytes_(bytes) {}

  /// Whether `reply` may still be sent. Every datagram counts with its IP and UDP headers, so that
  /// many short replies to one bundle draw no more either.
  [[nodiscard]] bool fits(const Message& reply) const;
  /// The reply as it may be sent, taken off what is left: whole, or a /fail with its reason cut
  /// short. nullopt: it does not fit, and nothing is taken off.
  [[nodiscard]] std::optional<Message> take(const Message& reply);
  /// Takes `later` off in any case: this datagram will draw it some day.
  void owe(const Message& later);

  /// For people, behind the asker's name, when `reply` to `command` did not fit: how long the
  /// question was, how long its reply is, what to do.
  [[nodiscard]] std::string complaint(const std::string& command, const Message& reply) const;

 private:
  bool limited_;
  std::size_t bytes_;      ///< of the datagram
  std::size_t spent_ = 0;  ///< on replies, with a header each [bytes]
};

}  // namespace splash::protocol
