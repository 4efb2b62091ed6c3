// SPDX-License-Identifier: MIT
// Collects the report of a run from the parts of the program that counted.
#pragma once

#include "sim-server/send/event_sender.hpp"
#include "sim-server/serve/overload.hpp"
#include "sim-server/serve/pacer.hpp"
#include "sim-server/serve/report.hpp"
#include "sim-server/simulation/simulation.hpp"

namespace splash::sim {

/// Returns the report without the device, the wall time and the counts of targets and trackers.
[[nodiscard]] RunReport report_on(const Simulation& simulation, const SendCounts& sent,
                                  const PacerCounts& paced, const Overload& overload);

}  // namespace splash::sim
