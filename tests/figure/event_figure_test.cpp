// SPDX-License-Identifier: MIT
#include "synth-server/figure/event_figure.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "protocol/event_log.hpp"
#include "protocol/message.hpp"
#include "tests/figure/wav_text.hpp"
#include "tests/support/temporary_folder.hpp"
#include "tests/support/text_of.hpp"

namespace splash::synth {
namespace {

using ::testing::StartsWith;

TEST(LevelMap, IsTheRootMeanSquareOfEachChannelAndColumn) {
  WavSignal signal{1000.0, {std::vector<float>(1000), std::vector<float>(1000)}};
  for (std::size_t i = 0; i < 500; ++i) {  // a sine of 50 Hz in the first half of channel 2
    signal.channels[1][i] =
        0.5F * static_cast<float>(std::sin(2.0 * std::numbers::pi * 0.05 * static_cast<double>(i)));
  }
  const LevelMap map = level_map(signal, 10);
  ASSERT_EQ(map.level_db.size(), 20U);
  for (std::size_t column = 0; column < 10; ++column) {
    EXPECT_EQ(map.level_db[column], kLowestLevel) << "channel 1, column " << column;
    const float expected = column < 5 ? -9.03F : kLowestLevel;  // 0.5 / sqrt 2
    EXPECT_NEAR(map.level_db[10 + column], expected, 0.01F) << "channel 2, column " << column;
  }
}

TEST(EventFigure, DrawsALogAndItsChannels) {
  const tests::TemporaryFolder folder;
  {
    protocol::LogWriter log(folder / "some.osc");
    protocol::Bubble bubble;
    bubble.radius = 0.004F;
    log.append(0.2, {protocol::to_message(protocol::Impact{1, 0, 2.0F, 1.5F, {}, 0.0F}),
                     protocol::to_message(bubble)});
  }
  std::vector<float> frames;
  for (int i = 0; i < 8000; ++i) {
    for (int channel = 0; channel < 4; ++channel) {
      frames.push_back(channel == 2 ? 0.1F * std::sin(0.3F * static_cast<float>(i)) : 0.0F);
    }
  }
  folder.write("some.wav", testing::float_file(4, 8000, frames));
  draw_events({folder / "some.osc", folder / "some.wav", "four \"tiles\""}, folder / "a.png");
  const std::string bytes = tests::text_of(folder / "a.png");
  EXPECT_THAT(bytes, StartsWith("\x89PNG"));
  EXPECT_GT(bytes.size(), 20'000U) << "an empty frame is smaller";
}

}  // namespace
}  // namespace splash::synth
