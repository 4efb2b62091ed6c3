// SPDX-License-Identifier: MIT
// When an event is played: its moment plus the fixed latency, on the sample clock; what comes late
// plays at once or not at all, what lies too far ahead is not believed, what has no time plays with
// the next block.
#pragma once

#include <cstdint>

#include "synth-server/play/sample_clock.hpp"

namespace splash::synth {

struct ScheduleSettings {
  double latency = -1.0;       ///< wanted, added to every moment [s]; negative: by the block
  double late_window = 0.050;  ///< later than this an event is dropped [s]
  double horizon = 2.0;        ///< further ahead a time tag is taken for a wrong clock [s]
};

enum class Timing {
  on_time,
  late,      ///< within the window: plays at the block's start
  too_late,  ///< dropped
  early,     ///< beyond the horizon: plays by arrival
};

struct Placement {
  Timing timing = Timing::on_time;
  std::int64_t sample = 0;  ///< never before the block's start; meaningless when too late
};

/// The wanted latency; without a wish (negative) one block, since that long before its last sample
/// sounds a block is asked for, and half a block more for late callbacks, and 5 ms or more [s].
/// A sender whose tags lie ahead by as much needs none: its events sound at their moment.
[[nodiscard]] double latency_for(double wanted, int block, double sample_rate) noexcept;

/// An event without a time: as soon as it can be, `offset` [s] into the block, no latency added.
[[nodiscard]] Placement place_at_once(double offset, std::int64_t block_start, double sample_rate,
                                      const ScheduleSettings& settings) noexcept;

/// `moment`: when the event happens; `by_arrival`: when it would, going by its arrival and the
/// delay it names [s, monotonic]. `block_start`: first sample that can still be rendered.
[[nodiscard]] Placement place(double moment, double by_arrival, const SampleClock& clock,
                              std::int64_t block_start, const ScheduleSettings& settings) noexcept;

}  // namespace splash::synth
