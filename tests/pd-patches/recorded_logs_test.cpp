// SPDX-License-Identifier: MIT
// Logs of real runs, committed under tests/data: their bubbles and cavities through both synths.
#include <gtest/gtest.h>

#include <iostream>

#include "tests/pd-patches/rendering.hpp"

namespace splash::pd {
namespace {

constexpr double kLongest = 8.0;  ///< of a log is rendered: 36 channels in tables of Pd [s]

TEST(RecordedLogs, SoundAlike) {
  std::size_t compared = 0;
  const auto folder = std::filesystem::path(SPLASH_SOURCE_DIR) / "tests/data";
  for (const auto& entry : std::filesystem::directory_iterator(folder)) {
    if (entry.path().extension() != ".osc") continue;
    const auto log = tones(protocol::read_log(entry.path()), kLongest);
    constexpr auto kFrames = static_cast<std::int64_t>((kLongest + 0.5) * kRate);
    const Both both = render_both(log, kTiles, kFrames);
    const double peak = loudest(both.synth);
    // Above its ceiling the engine limits and the patch clips: those would not be alike.
    ASSERT_GT(peak, 0.0) << entry.path();
    ASSERT_LT(peak, 0.89) << entry.path();
    const double level = both.apart(peak);
    std::cout << entry.path().filename() << ": " << level << " dB re peak " << peak << '\n';
    EXPECT_LT(level, -80.0) << entry.path();
    ++compared;
  }
  EXPECT_GE(compared, 3U);
}

}  // namespace
}  // namespace splash::pd
