// SPDX-License-Identifier: MIT
// An event log as a score for scsynth's non-real-time mode. The framing is the log's own: bundles,
// each behind its size, their time tags counting seconds from the start; only the messages change.
#pragma once

#include <cstdint>
#include <filesystem>
#include <vector>

#include "protocol/event_log.hpp"

namespace splash::supercollider {

struct ScoreSettings {
  double sample_rate = 48000.0;  ///< [Hz]
  double gain = 1.0;             ///< from metres to full scale [1/m]
  double highest = 750.0;        ///< bubbles born above this are left out [Hz]
  std::int64_t frames = 48000;   ///< rendered
};

/// Writes each bubble and cavity of the log as /s_new at its sample; impacts are noise, which no
/// two engines draw alike, and left out. Returns how many there are.
int write_score(const std::vector<protocol::LogEntry>& log, const ScoreSettings& settings,
                const std::filesystem::path& path);

/// Renders it with the real scsynth: one channel. Throws std::runtime_error with what it printed.
[[nodiscard]] std::vector<float> render_with_scsynth(const std::vector<protocol::LogEntry>& log,
                                                     const ScoreSettings& settings);

}  // namespace splash::supercollider
