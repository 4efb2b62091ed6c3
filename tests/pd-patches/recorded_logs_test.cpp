// SPDX-License-Identifier: MIT
// Logs of real runs, committed under tests/data: their bubbles and cavities through both synths.
#include <gtest/gtest.h>

#include <algorithm>
#include <iostream>
#include <variant>

#include "tests/pd-patches/rendering.hpp"

namespace splash::pd {
namespace {

constexpr double kLongest = 8.0;  ///< of a log is rendered: 36 channels in tables of Pd [s]

/// The bubbles and cavities of a log's beginning: noise cannot be compared sample by sample.
std::vector<protocol::LogEntry> tones(const std::vector<protocol::LogEntry>& log) {
  std::vector<protocol::LogEntry> kept;
  for (const protocol::LogEntry& entry : log) {
    if (entry.seconds > kLongest) break;
    kept.push_back({entry.seconds, {}});
    for (const protocol::Message& message : entry.messages) {
      const auto event = protocol::to_event(message);
      if (event && !std::holds_alternative<protocol::Impact>(*event)) {
        kept.back().messages.push_back(message);
      }
    }
  }
  return kept;
}

double loudest(const Channels& channels) {
  float peak = 0.0F;
  for (const auto& channel : channels) {
    for (const float sample : channel) peak = std::max(peak, std::abs(sample));
  }
  return static_cast<double>(peak);
}

TEST(RecordedLogs, SoundAlike) {
  std::size_t compared = 0;
  const auto folder = std::filesystem::path(SPLASH_SOURCE_DIR) / "tests/data";
  for (const auto& entry : std::filesystem::directory_iterator(folder)) {
    if (entry.path().extension() != ".osc") continue;
    const auto log = tones(protocol::read_log(entry.path()));
    constexpr auto kFrames = static_cast<std::int64_t>((kLongest + 0.5) * kRate);
    const Channels synth = render_with_synth(log, kTiles, kFrames);
    const double peak = loudest(synth);
    // Above its ceiling the engine limits and the patch clips: those would not be alike.
    ASSERT_GT(peak, 0.0) << entry.path();
    ASSERT_LT(peak, 0.89) << entry.path();
    const Channels pd = render_with_pd(log, kTiles, kFrames);
    const double level = decibels(largest_difference(pd, synth, 0, kFrames) / peak);
    std::cout << entry.path().filename() << ": " << level << " dB re peak " << peak << '\n';
    EXPECT_LT(level, -80.0) << entry.path();
    ++compared;
  }
  EXPECT_GE(compared, 3U);
}

}  // namespace
}  // namespace splash::pd
