// SPDX-License-Identifier: MIT
// Computes from the simulator's /force how fast the forces on bodies change; and requests these
// messages with /notify 2, a subscription that lasts a minute.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "protocol/message.hpp"
#include "protocol/udp_socket.hpp"
#include "synth-server/play/command_queue.hpp"

namespace splash::synth {

/// Returns whether a packet carries forces. Such packets are numbered separately from events.
[[nodiscard]] bool tells_forces(const protocol::Packet& packet) noexcept;

class Forces {
 public:
  /// What a bundle says that the address table accepts. `time`: its tag [s]; only differences
  /// count. A body's first force, one after a gap and one that comes twice give no push.
  [[nodiscard]] std::vector<Push> take(const protocol::Packet& packet, double time);

  static constexpr double kGap = 0.1;       ///< a body that is told again so late begins anew [s]
  static constexpr double kLeast = 1e-4;    ///< forces are told further apart [s]
  static constexpr double kMostRate = 1e6;  ///< no body bears more; what is over it is cut [N/s]

 private:
  struct Told {
    std::int32_t session = -1;  ///< of the sender; -1: never
    double time = 0.0;          ///< [s]
    std::array<double, 3> force{};
  };
  std::array<Told, 256> last_;
};

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
  /// A line for people where the simulator refuses for another reason than before; else empty.
  [[nodiscard]] std::string refusal(const protocol::Message& reply, const protocol::Endpoint& from);

  static constexpr double kPeriod = 5.0;  ///< between two questions [s]

 private:
  ForceSource source_;
  double next_ = 0.0;  ///< [s, monotonic]
  bool asked_ = false;
  std::string refused_;
};

}  // namespace splash::synth
