// SPDX-License-Identifier: MIT
// Blocks of any size, at every usual rate, on one, two and 36 channels: finite, within the ceiling,
// and the same sound to the last bit.
#include <gtest/gtest.h>

#include <cmath>
#include <string>

#include "tests/synth-server/render/rendering.hpp"

namespace splash::synth {
namespace {

struct Setup {
  std::string rig;
  double rate = 48000.0;  ///< [Hz]
};

class AnyBlocks : public testing::TestWithParam<Setup> {};
INSTANTIATE_TEST_SUITE_P(RigsAndRates, AnyBlocks,
                         testing::Values(Setup{"handheld", 44100.0}, Setup{"handheld", 48000.0},
                                         Setup{"handheld", 96000.0}, Setup{"stereo", 44100.0},
                                         Setup{"stereo", 48000.0}, Setup{"stereo", 96000.0},
                                         Setup{"tiles36", 44100.0}, Setup{"tiles36", 48000.0},
                                         Setup{"tiles36", 96000.0}),
                         [](const auto& setup) {
                           return setup.param.rig + "_" +
                                  std::to_string(static_cast<int>(setup.param.rate));
                         });

TEST_P(AnyBlocks, AreFiniteBoundedAndSoundTheSame) {
  const Rig rig = shipped_rig(GetParam().rig);
  auto settings = file_settings();
  settings.sample_rate = GetParam().rate;
  settings.max_voices = 200;  // some have to be stolen
  settings.max_block = 8192;
  const auto events = splashes(800, 6000);  // louder than the ceiling, on few channels
  EngineCounters counters;
  const auto rendered = [&](const std::vector<int>& blocks) {
    Engine engine(rig, settings);
    for (const TimedEvent& event : events) EXPECT_TRUE(engine.schedule(event));
    Channels out = render(engine, 8192, blocks);
    counters = engine.counters();
    return out;
  };
  const Channels whole = rendered({8192});
  const EngineCounters first = counters;
  EXPECT_GT(first.stolen, 0U);
  double most = 0.0;
  for (const auto& channel : whole) {
    for (const float sample : channel) ASSERT_TRUE(std::isfinite(sample));
    most = std::max(most, loudest(channel));
  }
  EXPECT_LE(most, rig.outputs[0].ceiling);
  EXPECT_GT(most, 0.1) << "too quiet to prove anything";
  for (const std::vector<int>& blocks :
       std::vector<std::vector<int>>{{1}, {2, 3}, {16}, {100}, {128}, {333, 4096}, {4096}}) {
    EXPECT_EQ(rendered(blocks), whole) << "first block of " << blocks.front();
    EXPECT_EQ(counters.stolen, first.stolen);
    EXPECT_EQ(counters.dropped_pool, first.dropped_pool);
    EXPECT_EQ(counters.channels_skipped, first.channels_skipped);
  }
}

}  // namespace
}  // namespace splash::synth
