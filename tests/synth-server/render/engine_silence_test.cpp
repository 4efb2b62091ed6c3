// SPDX-License-Identifier: MIT
// Nothing starts or stops with a click: the start ramp, silence and clear.
#include <gtest/gtest.h>

#include <cmath>

#include "tests/synth-server/render/rendering.hpp"

namespace splash::synth {
namespace {

/// Largest step between samples.
double largest_step(const std::vector<float>& out, float before) {
  double most = 0.0;
  for (const float v : out) {
    most = std::max(most, std::abs(static_cast<double>(v) - static_cast<double>(before)));
    before = v;
  }
  return most;
}

/// A cavity of 5 cm: 60 Hz and 0.5 of full scale. Its sine's largest step is 2 pi 60 / 48000 of
/// that.
constexpr double kSineStep = 0.5 * 2.0 * 3.1416 * 60.0 / 48000.0;

TEST(StartRamp, OpensDuringTwoSeconds) {
  auto settings = file_settings();
  settings.start_ramp = 2.0;
  Engine engine(open_rig(), settings);
  EXPECT_EQ(engine.counters().voices, 0U);
  for (int i = 0; i < 8; ++i) engine.schedule({cavity(0.03F), i * 12000});
  const auto out = render(engine, 96000 + 24000).front();
  const auto level = [&](int from) {
    return loudest({out.begin() + from, out.begin() + from + 12000});
  };
  EXPECT_LT(level(0), 0.2 * level(60000));
  EXPECT_LT(level(36000), level(84000));
}

TEST(Silence, FadesOutIn20MillisecondsWithoutAClickAndComesBack) {
  Engine engine(open_rig(), file_settings());
  engine.schedule({cavity(0.05F), 0});
  const auto before = render(engine, 4800).front();
  EXPECT_FALSE(engine.silenced());
  engine.silence(true);
  const auto fading = render(engine, 961).front();
  EXPECT_TRUE(engine.silenced());
  EXPECT_LT(largest_step(fading, before.back()), 1.5 * kSineStep);
  EXPECT_EQ(loudest(render(engine, 480).front()), 0.0);
  engine.silence(false);
  const auto back = render(engine, 1500).front();
  EXPECT_LT(largest_step(back, 0.0F), 1.5 * kSineStep);
  EXPECT_GT(loudest(back), 0.1);
  EXPECT_FALSE(engine.silenced());
}

TEST(Clear, DropsWhatWaitsAndFadesWhatSounds) {
  Engine engine(open_rig(), file_settings());
  engine.schedule({cavity(0.05F), 0});
  engine.schedule({cavity(0.05F), 100000});
  const auto before = render(engine, 4800).front();
  engine.clear();
  EXPECT_EQ(engine.counters().dropped_cleared, 1U);
  EXPECT_EQ(engine.counters().scheduled, 0U);
  const auto fading = render(engine, 480).front();
  // 5 ms of fade add a slope of 1.5 A / 240 samples to the sine's.
  EXPECT_LT(largest_step(fading, before.back()), kSineStep + 0.5 * 1.5 / 240.0);
  EXPECT_EQ(engine.counters().voices, 0U);
  render(engine, 48000);  // the 1 Hz high-pass swings out
  EXPECT_LT(loudest(render(engine, 96000).front()), 0.01);
  engine.schedule({bubble(0.005F), engine.clock()});
  render(engine, 100);
  EXPECT_EQ(engine.counters().voices, 1U) << "events after clear() play";
}

}  // namespace
}  // namespace splash::synth
