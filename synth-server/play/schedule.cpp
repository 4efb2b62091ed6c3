// SPDX-License-Identifier: MIT
#include "synth-server/play/schedule.hpp"

#include <algorithm>
#include <cmath>

namespace splash::synth {
namespace {

/// A block lasts until the next one is asked for; half of one is for late callbacks [blocks].
constexpr double kLatencyBlocks = 1.5;
constexpr double kLeastLatency = 0.005;  ///< [s]

}  // namespace

double latency_for(double wanted, int block, double sample_rate) noexcept {
  const double block_seconds = block / sample_rate;
  if (wanted >= 0.0) return wanted;
  return std::max(kLeastLatency, kLatencyBlocks * block_seconds);
}

Placement place_at_once(double offset, std::int64_t block_start, double sample_rate,
                        const ScheduleSettings& settings) noexcept {
  const double ahead = std::clamp(offset, 0.0, settings.horizon);
  return {offset > settings.horizon ? Timing::early : Timing::on_time,
          block_start + std::llround(ahead * sample_rate)};
}

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
