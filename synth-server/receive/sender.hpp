// SPDX-License-Identifier: MIT
// The senders of framed bundles: who they are, whether they still live, what of theirs was lost.
#pragma once

#include <cstdint>
#include <optional>
#include <vector>

#include "protocol/event.hpp"
#include "protocol/limits.hpp"
#include "protocol/sequence.hpp"
#include "protocol/time_tag.hpp"
#include "protocol/udp_socket.hpp"
#include "synth-server/receive/sender_clock.hpp"

namespace splash::synth {

struct Sender {
  explicit Sender(const protocol::Endpoint& from) : endpoint(from), clock(is_loopback(from)) {}

  protocol::Endpoint endpoint;
  protocol::SequenceWatch sequence;
  SenderClock clock;
  bool present = false;     ///< its lease has not run out
  double heard = 0.0;       ///< last frame [s, monotonic]
  double next_ping = 0.0;   ///< [s, monotonic]
  int pings = 0;            ///< sent so far
  protocol::TimeTag asked;  ///< stamp of the ping that waits for its pong
};

/// A sender that says nothing for so long is gone [s].
inline constexpr double kLease = protocol::kPeerLease;

/// What all senders together lost, doubled and reordered, in bundles; those forgotten included.
struct SequenceTotals {
  std::uint64_t received = 0;
  std::uint64_t lost = 0;
  std::uint64_t duplicates = 0;
  std::uint64_t reordered = 0;
  std::uint64_t sessions = 0;
};

class SenderTable {
 public:
  /// The sender at `from`; a new one takes the place of the longest unheard when the table is full.
  Sender& at(const protocol::Endpoint& from);
  [[nodiscard]] Sender* find(const protocol::Endpoint& from) noexcept;
  [[nodiscard]] std::vector<Sender>& all() noexcept { return senders_; }

  /// Ends leases that ran out by `now`. True when that leaves no sender.
  bool expire(double now) noexcept;
  /// When the next lease runs out [s, monotonic]; infinity: no sender is present.
  [[nodiscard]] double next_expiry() const noexcept;
  [[nodiscard]] bool anybody_present() const noexcept;
  [[nodiscard]] SequenceTotals totals() const noexcept;

 private:
  std::vector<Sender> senders_;
  SequenceTotals forgotten_;
};

}  // namespace splash::synth
