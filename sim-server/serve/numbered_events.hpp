// SPDX-License-Identifier: MIT
// From what was found to what is told: events get their ids, their body and the moment they shall
// sound.
#pragma once

#include <vector>

#include "protocol/event.hpp"
#include "sim-server/detect/detection.hpp"
#include "sim-server/send/split.hpp"

namespace splash::sim {

class Simulation;

/// Counts the events of a session.
using EventIds = protocol::ByKind<int>;

/// Impacts sound when the surfaces meet; bubbles and cavities `latency` seconds after they
/// happened, which hides how long it took to find them.
[[nodiscard]] std::vector<TimedEvent> number_events(const Detections& found,
                                                    const Simulation& simulation, double latency,
                                                    EventIds& ids);

}  // namespace splash::sim
