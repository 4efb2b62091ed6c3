// SPDX-License-Identifier: MIT
// A frame's events as the messages of its bundles: their order, and where a bundle must be cut. It
// depends on nothing but the events, so that the wire and the log are cut alike.
#pragma once

#include <cstddef>
#include <vector>

#include "protocol/event.hpp"
#include "protocol/message.hpp"

namespace splash::sim {

/// An event and the moment it shall sound.
struct TimedEvent {
  protocol::Event event;
  double play_seconds = 0.0;  ///< simulated time [s]
};

/// The messages of one datagram: /frame, which the sender fills in, then the events.
struct EventBundle {
  std::vector<protocol::Message> messages = std::vector<protocol::Message>(1);
  std::vector<double> play_seconds = {};  ///< of each event, simulated time [s]
};

/// By moment, then kind (in the order of protocol::Event), then id.
void sort_events(std::vector<TimedEvent>& events);

/// Makes each event a message, in its order, and fills bundles with as many as kMaxDatagram and
/// kMaxMessages allow. No events: no bundles. The messages' offsets are 0.
[[nodiscard]] std::vector<EventBundle> bundle_events(const std::vector<TimedEvent>& events);

}  // namespace splash::sim
