// SPDX-License-Identifier: MIT
// Which of several senders is followed, for a body's poses or for a floor: of those that send, the
// one that began last. What sends again after a silence begins anew.
#pragma once

#include <cstdint>
#include <limits>
#include <optional>
#include <vector>

#include "protocol/udp_socket.hpp"

namespace splash::sim {

/// A sender of poses that says nothing for longer than this has ended [s].
inline constexpr double kSenderEnds = 0.5;
/// The same of a floor, of which nobody may touch anything for a while [s].
inline constexpr double kFloorEnds = 3.0;

/// The senders of one body's poses, or of one floor.
class PoseSenders {
 public:
  /// `ends`: the silence after which a sender has ended [s].
  explicit PoseSenders(double ends = kSenderEnds) : ends_(ends) {}

  /// Whether a pose that `from` sends at `now` [s] moves the body: no other sender began later.
  [[nodiscard]] bool lets(const protocol::Endpoint& from, double now) const;
  /// A pose of `from` came. Returns whom the body follows in its place, the first time that these
  /// two are seen to send at once; empty: nobody, or that was told.
  std::optional<protocol::Endpoint> hear(const protocol::Endpoint& from, double now);
  /// Whose last pose the body followed; empty: it takes none.
  void follow(const std::optional<protocol::Endpoint>& followed) { followed_ = followed; }
  [[nodiscard]] bool is_followed() const noexcept { return followed_.has_value(); }
  /// When any of them sent last [s].
  [[nodiscard]] double heard() const;
  [[nodiscard]] bool are_silent(double now) const { return now - heard() > ends_; }
  /// Until `from` sends again the others have the body; then it begins anew.
  void forget(const protocol::Endpoint& from);

 private:
  struct Sender {
    protocol::Endpoint from;
    double began = 0.0;                           ///< its first pose since a silence [s]
    double heard = 0.0;                           ///< its last one [s]
    std::optional<protocol::Endpoint> told = {};  ///< the other one of the last line on it
  };
  double ends_;  ///< [s]
  std::vector<Sender> senders_;
  std::optional<protocol::Endpoint> followed_;
  double next_line_ = -std::numeric_limits<double>::infinity();  ///< [s]
};

}  // namespace splash::sim
