// SPDX-License-Identifier: MIT
// Which sender of poses moves a body: of those that send, the one that began last. What sends again
// after a silence begins anew.
#pragma once

#include <cstdint>
#include <limits>
#include <optional>
#include <vector>

#include "protocol/udp_socket.hpp"

namespace splash::sim {

/// A sender that says nothing for longer than this has ended [s].
inline constexpr double kSenderEnds = 0.5;

/// The senders of one body's poses.
class PoseSenders {
 public:
  /// Whether a pose that `from` sends at `now` [s] moves the body: no other sender began later.
  [[nodiscard]] bool lets(const protocol::Endpoint& from, double now) const;
  /// A pose of `from` came. Returns whom the body follows in its place, the first time that these
  /// two are seen to send at once; empty: nobody, or that was told.
  std::optional<protocol::Endpoint> hear(const protocol::Endpoint& from, double now);
  /// Whose last pose the body followed; empty: it takes none.
  void follow(const std::optional<protocol::Endpoint>& followed) { followed_ = followed; }
  [[nodiscard]] bool is_followed() const noexcept { return followed_.has_value(); }
  /// Until `from` sends again the others have the body; then it begins anew.
  void forget(const protocol::Endpoint& from);

 private:
  struct Sender {
    protocol::Endpoint from;
    double began = 0.0;                           ///< its first pose since a silence [s]
    double heard = 0.0;                           ///< its last one [s]
    std::optional<protocol::Endpoint> told = {};  ///< the other one of the last line on it
  };
  std::vector<Sender> senders_;
  std::optional<protocol::Endpoint> followed_;
  double next_line_ = -std::numeric_limits<double>::infinity();  ///< [s]
};

}  // namespace splash::sim
