// SPDX-License-Identifier: MIT
// Forces to those who asked for them with /notify 2: for each body where it is, how it moves, what
// the water does to it and how that depends on its speed.
#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "protocol/message.hpp"
#include "protocol/udp_socket.hpp"
#include "sim-server/send/targets.hpp"

namespace splash::sim {

/// Of a body at a frame's end; force and rate are means over the frame.
struct ForceReading {
  std::int32_t body = 0;             ///< index among the scene's
  std::array<double, 7> at = {};     ///< place [m], rotation x y z w
  std::array<double, 6> twist = {};  ///< velocity [m/s], angular velocity [rad/s]
  std::array<double, 6> force = {};  ///< force [N], torque about its centre [N m]
  std::array<double, 6> rate = {};   ///< of these by the twist's own part [N s/m], [N m s]
};

/// The messages of up to five bodies at a time, which are well below a datagram; none of a body
/// whose numbers break the address table.
[[nodiscard]] std::vector<std::vector<protocol::Message>> force_bundles(
    const std::vector<ForceReading>& readings);

class ForceSender {
 public:
  /// `session`: that of the program's events. Both references outlive the sender.
  ForceSender(Targets& targets, protocol::UdpSocket& socket, std::int32_t session)
      : targets_(targets), socket_(socket), session_(session) {}

  /// A frame's, which ended at `unix_time` [s].
  void send(std::int64_t step, double unix_time,
            const std::vector<std::vector<protocol::Message>>& bundles);

  [[nodiscard]] std::uint64_t bundles() const noexcept { return bundles_; }

 private:
  Targets& targets_;
  protocol::UdpSocket& socket_;
  std::int32_t session_;
  std::int32_t sequence_ = 0;
  std::uint64_t bundles_ = 0;
};

}  // namespace splash::sim
