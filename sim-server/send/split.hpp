// SPDX-License-Identifier: MIT
// The order of a frame's events and where its bundle must be cut. Depends on nothing but the
// events, so that the wire and the log are cut alike.
#pragma once

#include <cstddef>
#include <vector>

#include "protocol/event.hpp"

namespace splash::sim {

/// An event and the moment it shall sound.
struct TimedEvent {
  protocol::Event event;
  double play_seconds = 0.0;  ///< simulated time [s]
};

/// By moment, then kind (impact, bubble, cavity), then id.
void sort_events(std::vector<TimedEvent>& events);

/// Events of one datagram behind its /frame: as many as kMaxDatagram and kMaxMessages allow, in
/// their order. No events: no parts.
[[nodiscard]] std::vector<std::vector<TimedEvent>> split_events(
    const std::vector<TimedEvent>& events);

/// Sets the event's moment after its bundle's time [ms].
void set_offset(protocol::Event& event, double offset_ms);

}  // namespace splash::sim
