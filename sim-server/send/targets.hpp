// SPDX-License-Identifier: MIT
// Who gets the events: the targets named at start, for good, and those who asked with /notify, for
// a lease. Safe to use from the control's thread and the simulator's at once.
#pragma once

#include <cstddef>
#include <cstdint>
#include <functional>
#include <mutex>
#include <vector>

#include "protocol/gate.hpp"
#include "protocol/limits.hpp"
#include "protocol/time_tag.hpp"
#include "protocol/udp_socket.hpp"

namespace splash::sim {

using protocol::kEventStream;
using protocol::kForceStream;
using protocol::kMaxSubscribers;
using protocol::kSubscriptionLease;

struct Target {
  protocol::Endpoint endpoint;
  bool fixed = true;     ///< named at start, else a subscriber
  double expires = 0.0;  ///< of what was asked for with /notify, monotonic [s]
  unsigned streams = kEventStream;
  std::uint64_t sent = 0;    ///< datagrams handed to the kernel
  std::uint64_t failed = 0;  ///< datagrams the kernel refused
};

class Targets {
 public:
  using Clock = std::function<double()>;

  /// Each endpoint once, however often it is named. `clock`: monotonic [s].
  explicit Targets(const std::vector<protocol::Endpoint>& fixed,
                   Clock clock = protocol::monotonic_now);

  /// False when the list is full. Subscribing again renews the lease. Targets named at start get
  /// events whatever they ask for.
  bool subscribe(const protocol::Endpoint& endpoint, unsigned streams = kEventStream);
  /// False when it was no subscriber. Targets named at start stay.
  bool unsubscribe(const protocol::Endpoint& endpoint);
  /// Any sign of life renews the lease of a subscriber.
  void renew(const protocol::Endpoint& endpoint);

  /// The same bytes to all of a stream. Refusals are counted, not thrown: UDP may lose.
  void send(protocol::UdpSocket& socket, protocol::Bytes packet, unsigned stream = kEventStream);
  /// The same to those alone who asked for the events with /notify: a word on them, no event.
  void tell(protocol::UdpSocket& socket, protocol::Bytes packet);
  /// Whether anybody gets the stream.
  [[nodiscard]] bool wants(unsigned stream);

  [[nodiscard]] std::vector<Target> list() const;

 private:
  void drop_expired();
  [[nodiscard]] bool takes(const Target& target, unsigned stream) const;

  mutable std::mutex mutex_;
  Clock clock_;
  std::vector<Target> targets_;
};

/// Where a socket must be bound to reach all of `targets`, and whoever asks for events at
/// `listening`: loopback where that is enough, else every interface; any free port.
[[nodiscard]] protocol::Endpoint sending_endpoint(const std::vector<protocol::Endpoint>& targets,
                                                  const protocol::Endpoint& listening = {});

}  // namespace splash::sim
