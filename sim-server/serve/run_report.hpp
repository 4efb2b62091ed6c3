// SPDX-License-Identifier: MIT
// The report of a run, from those who counted.
#pragma once

#include "sim-server/send/event_sender.hpp"
#include "sim-server/serve/overload.hpp"
#include "sim-server/serve/pacer.hpp"
#include "sim-server/serve/report.hpp"
#include "sim-server/simulation/simulation.hpp"

namespace splash::sim {

/// All but the device, wall time, and what the targets and trackers had to say.
[[nodiscard]] RunReport report_on(const Simulation& simulation, const SendCounts& sent,
                                  const PacerCounts& paced, const Overload& overload);

}  // namespace splash::sim
