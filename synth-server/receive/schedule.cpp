// SPDX-License-Identifier: MIT
#include "synth-server/receive/schedule.hpp"

#include <algorithm>
#include <cmath>

namespace splash::synth {

Placement place(double moment, double by_arrival, const SampleClock& clock,
                std::int64_t block_start, const ScheduleSettings& settings) noexcept {
  const double furthest = clock.block_time() + settings.horizon;
  Timing timing = Timing::on_time;
  if (moment > furthest) {
    timing = Timing::early;
    moment = std::min(by_arrival, furthest);  // the delay an event names may be as wrong
  }
  const double sample = clock.sample_at(moment + settings.latency);
  const double late = static_cast<double>(block_start) - sample;  // [samples]
  if (late > settings.late_window * clock.rate()) return {Timing::too_late, block_start};
  const std::int64_t rounded = std::llround(sample);
  if (rounded >= block_start) return {timing, rounded};
  return {timing == Timing::early ? timing : Timing::late, block_start};
}

}  // namespace splash::synth
