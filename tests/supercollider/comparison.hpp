// SPDX-License-Identifier: MIT
// One log through synth-server's engine and through scsynth: one channel each, alike in band.
#pragma once

#include <array>
#include <filesystem>
#include <vector>

#include "protocol/event_log.hpp"

namespace splash::supercollider {

/// The scenes whose logs are committed under tests/data.
inline constexpr std::array kScenes = {"basin", "plunge", "pool"};
[[nodiscard]] std::vector<protocol::LogEntry> scene_log(const std::string& scene);

struct Pair {
  std::vector<float> synth;
  std::vector<float> scsynth;  ///< filtered as the engine filters: scsynth plays the voices alone
};

/// Bubbles and cavities through a transducer of 20 to 750 Hz. `gain`: from metres to full scale, so
/// that no limiter acts; but high, since the engine ends voices 120 dB under full scale [1/m].
[[nodiscard]] Pair render_both(const std::vector<protocol::LogEntry>& log, std::int64_t frames,
                               double gain);

/// The gain with which the engine's rendering has a peak of one half [1/m].
[[nodiscard]] double loud_gain(const std::vector<protocol::LogEntry>& log, std::int64_t frames);

}  // namespace splash::supercollider
