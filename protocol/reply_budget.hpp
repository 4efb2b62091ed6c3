// SPDX-License-Identifier: MIT
// How much and how often a host is answered.
#pragma once

#include <cstddef>
#include <optional>
#include <string>
#include <vector>

#include "protocol/message.hpp"
#include "protocol/udp_socket.hpp"

namespace splash::protocol {

/// Limits the replies to one datagram: together they never have more bytes than the datagram. The
/// address of a UDP sender may be forged, and larger replies would flood a host that never asked
/// (reflection attack).
class ReplyBudget {
 public:
  /// `bytes`: the size of the datagram that came from `asker`. The program's own host (127.0.0.0/8)
  /// has no limit: the kernel drops what comes from outside under such an address (RFC 1122,
  /// 3.2.1.3).
  ReplyBudget(const Endpoint& asker, std::size_t bytes) noexcept
      : limited_(!is_loopback(asker)), bytes_(bytes) {}

  /// Returns whether `reply` may still be sent. Every datagram counts with its IP and UDP headers,
  /// so that many short replies to one bundle have no more bytes either.
  [[nodiscard]] bool fits(const Message& reply) const;
  /// Returns the reply as it may be sent and takes its size off the budget: the whole reply, or a
  /// /fail whose reason is cut short. nullopt: it does not fit, and nothing is taken off.
  [[nodiscard]] std::optional<Message> take(const Message& reply);
  /// Takes a message off the budget that this datagram causes later, whether or not it fits.
  void owe(const Message& later);

  /// A line for the log, to be put behind the asker's name, when `reply` to `command` did not fit:
  /// it has the sizes of both and what to do.
  [[nodiscard]] std::string complaint(const std::string& command, const Message& reply) const;

 private:
  bool limited_;
  std::size_t bytes_;      ///< of the datagram
  std::size_t spent_ = 0;  ///< on replies, with a header each [bytes]
};

// Padding of requests against amplification: text behind a command's own arguments, which is
// ignored, makes the request as long as its reply. Only then is another host answered
// (reply_budget.hpp).

/// The size of a request that still is answered when fields are added to its reply; the longest
/// reply at present, the synth's /status.reply, has 116 [bytes].
inline constexpr std::size_t kFilledQuestion = 256;

/// Returns `command` with text behind it, so that it has `bytes` on the wire or, where no text is
/// so short, four more. Throws std::length_error when a message cannot be so long.
[[nodiscard]] Message filled_up(Message command, std::size_t bytes);

/// A token bucket for each peer: no peer draws more replies, or lines in the log, than a person or
/// a clock needs, and one that floods takes none from the others.
class RateLimit {
 public:
  /// The number of peers that are remembered; the one idle for longest is forgotten first.
  static constexpr std::size_t kMaxPeers = 64;

  /// `rate`: tokens per second in the long run [1/s]; `burst`: tokens at once after a rest.
  RateLimit(double rate, double burst) noexcept : rate_(rate), burst_(burst) {}

  /// Whether `peer` may have one more at `now` (monotonic [s]); takes a token when it may. On this
  /// host each port is a peer. Another host is one peer, whatever ports its datagrams name: they
  /// may be forged.
  [[nodiscard]] bool allow(const Endpoint& peer, double now);

 private:
  struct Bucket {
    Endpoint peer;
    double tokens = 0.0;
    double updated = 0.0;  ///< monotonic [s]
  };
  Bucket& bucket_of(const Endpoint& peer, double now);

  double rate_;   ///< [1/s]
  double burst_;  ///< [1]
  std::vector<Bucket> buckets_;
};

}  // namespace splash::protocol
