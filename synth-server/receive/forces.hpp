// SPDX-License-Identifier: MIT
// Requests the simulator's /force messages with /notify 2, a subscription that lasts a minute.
#pragma once

#include <functional>
#include <optional>
#include <string>
#include <utility>

#include "protocol/message.hpp"
#include "protocol/udp_socket.hpp"

namespace splash::synth {

/// The simulator to request forces from, and whether they are needed at present.
struct ForceSource {
  std::optional<protocol::Endpoint> simulator = {};
  std::function<bool()> wanted = [] { return false; };
};

class ForceQuestion {
 public:
  explicit ForceQuestion(ForceSource source) : source_(std::move(source)) {}

  /// To be called often, at `now` [s, monotonic]: the message that is due, if any.
  [[nodiscard]] std::optional<protocol::Message> due(double now);
  /// At the end: that no more is wanted, if it was.
  [[nodiscard]] std::optional<protocol::Message> last();
  [[nodiscard]] const protocol::Endpoint& simulator() const { return *source_.simulator; }
  /// Takes a reply of anybody's. A line for people where the simulator refuses for another reason
  /// than before; else empty.
  [[nodiscard]] std::string refusal(const protocol::Message& reply, const protocol::Endpoint& from);

  static constexpr double kPeriod = 5.0;  ///< between two questions [s] ...
  static constexpr double kEager =
      1.0;  ///< ... while none is answered: it may not be there yet [s]

 private:
  ForceSource source_;
  double asked_at_ = 0.0;  ///< [s, monotonic]
  double next_ = 0.0;      ///< [s, monotonic]
  bool asked_ = false;
  std::string refused_;
};

}  // namespace splash::synth
