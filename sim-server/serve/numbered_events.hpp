// SPDX-License-Identifier: MIT
// Turns detections into events of the wire: assigns ids, the nearest body and the moment to sound.
#pragma once

#include <vector>

#include "protocol/event.hpp"
#include "sim-server/detect/detection.hpp"
#include "sim-server/send/split.hpp"

namespace splash::sim {

class Simulation;

/// The next id of each kind of event in a session.
using EventIds = protocol::ByKind<int>;

/// Impacts sound when the surfaces meet; bubbles and cavities sound `latency` seconds after they
/// happened, which hides the time that their detection takes.
[[nodiscard]] std::vector<TimedEvent> number_events(const Detections& found,
                                                    const Simulation& simulation, double latency,
                                                    EventIds& ids);

}  // namespace splash::sim
