// SPDX-License-Identifier: MIT
// A log that --replay names: read, and rendered to WAV files, offline.
#pragma once

#include <vector>

#include "protocol/event_log.hpp"
#include "synth-server/options.hpp"
#include "synth-server/output/rig.hpp"

namespace splash::synth {

/// The log. Throws program::Failure when it cannot be read, or is longer than a week.
[[nodiscard]] std::vector<protocol::LogEntry> read_replay(const Options& options);

/// Renders options.replay to options.render (and its stems) and prints what it held. Throws
/// std::runtime_error when the log cannot be read or a file not be written.
void render_log(const Options& options, const Rig& rig);

}  // namespace splash::synth
