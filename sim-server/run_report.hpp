// SPDX-License-Identifier: MIT
// The report of a run, from those who counted.
#pragma once

#include "sim-server/overload.hpp"
#include "sim-server/send/event_sender.hpp"
#include "sim-server/send/pacer.hpp"
#include "sim-server/send/report.hpp"
#include "sim-server/simulation.hpp"

namespace splash::sim {

/// All but the device, wall time, and what the targets and trackers had to say.
[[nodiscard]] RunReport report_on(const Simulation& simulation, const SendCounts& sent,
                                  const PacerCounts& paced, const Overload& overload);

}  // namespace splash::sim
