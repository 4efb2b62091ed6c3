// SPDX-License-Identifier: MIT
// An event log as the text that Pd's [text sequence] plays: one event per line, behind the
// milliseconds since the line before. Each event starts on the sample on which synth-server's
// replay starts it, so that the two renderings can be compared sample by sample.
#pragma once

#include <cstdint>
#include <iosfwd>
#include <vector>

#include "protocol/event_log.hpp"

namespace splash::pd {

struct EventListReport {
  std::uint64_t events = 0;      ///< lines written
  std::uint64_t not_events = 0;  ///< messages of the log that are none, such as /frame
  std::int64_t last_sample = 0;  ///< on which the last event starts
};

/// Writes the events of `log` in the order of their samples at `sample_rate` [Hz, 8000 to 384000].
/// Throws std::invalid_argument on another rate, and program::DataError when an event lies beyond
/// 7 days.
EventListReport write_event_list(const std::vector<protocol::LogEntry>& log, double sample_rate,
                                 std::ostream& out);

}  // namespace splash::pd
