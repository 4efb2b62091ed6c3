// SPDX-License-Identifier: MIT
// What an engine is to play of a log, each at its sample from the log's start.
#pragma once

#include <algorithm>
#include <cstdint>
#include <vector>

#include "synth-server/render/engine.hpp"

namespace splash::synth {

/// Both in the order of their samples.
struct Score {
  std::vector<TimedEvent> events;
  std::vector<TimedPush> pushes;
};

/// 0: there is nothing to play.
[[nodiscard]] inline std::int64_t last_sample(const Score& score) noexcept {
  const std::int64_t event = score.events.empty() ? 0 : score.events.back().sample;
  return score.pushes.empty() ? event : std::max(event, score.pushes.back().sample);
}

}  // namespace splash::synth
