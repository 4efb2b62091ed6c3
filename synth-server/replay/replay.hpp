// SPDX-License-Identifier: MIT
// Renders an event log without a clock or a device. The same log, rig and settings give the same
// bits, in whatever blocks.
#pragma once

#include <cstdint>
#include <functional>
#include <optional>
#include <vector>

#include "protocol/event_log.hpp"
#include "synth-server/render/engine.hpp"

namespace splash::synth {

struct ReplaySettings {
  EngineSettings engine;  ///< its start_ramp is ignored for fade_in
  double fade_in = 0.0;   ///< of the first samples [s]; 0: a file begins open
  /// Rendered after the last event, the last 20 ms fading out [s]; empty: until all is silent.
  std::optional<double> tail;
  int block = 512;  ///< frames per call of the sink
};

/// Gets the rendered blocks in order; planar, channels[c][i].
using BlockSink = std::function<void(const float* const* channels, int frames)>;

struct ReplayReport {
  std::int64_t frames = 0;       ///< rendered
  std::uint64_t events = 0;      ///< in the log
  std::uint64_t not_events = 0;  ///< messages of the log that are none, such as /frame and /force
  EngineCounters counters;       ///< at the end
};

/// What sounds is left to ring out for so long at most [s]: a cavity of 0.3 m takes 14.5 s for 60
/// dB.
inline constexpr double kLongestRing = 60.0;

/// The log's events, and the changes of the forces that it tells; `others`: gets the number of all
/// messages that are no events. Throws program::DataError on a moment that no log can have.
[[nodiscard]] Score score_of(const std::vector<protocol::LogEntry>& log, double sample_rate,
                             std::uint64_t& others);

/// Renders from the log's start to its last event or force and the tail. Throws
/// std::invalid_argument on settings out of their limits, and what `sink` throws.
ReplayReport replay(const std::vector<protocol::LogEntry>& log, const Rig& rig,
                    const ReplaySettings& settings, const BlockSink& sink);

}  // namespace splash::synth
