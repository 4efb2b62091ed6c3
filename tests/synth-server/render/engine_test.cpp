// SPDX-License-Identifier: MIT
// The engine as its users see it: exact starts, the same bits in any blocks, honest counters.
#include "synth-server/render/engine.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <string>

#include "synth-server/voices/bubble_tone.hpp"
#include "tests/synth-server/render/rendering.hpp"

namespace splash::synth {
namespace {

TEST(Engine, StartsEventsOnTheirExactSample) {
  for (const std::int64_t start : {0, 1, 63, 64, 65, 500, 511, 512, 1000}) {
    Engine engine(open_rig(), file_settings());
    engine.schedule({bubble(0.005F), start});
    const auto out = render(engine, 2000).front();
    // The formula is nil at t = 0: sample `start` is the last zero.
    for (std::int64_t n = 0; n <= start; ++n) ASSERT_EQ(out[static_cast<std::size_t>(n)], 0.0F);
    EXPECT_GT(out[static_cast<std::size_t>(start + 1)], 0.0F) << start;
  }
}

TEST(Engine, RendersTheFormulaAtFullScale) {
  Engine engine(open_rig(), file_settings());
  engine.schedule({bubble(0.005F), 100});
  const auto out = render(engine, 9600).front();
  double worst = 0.0;
  for (std::size_t n = 100; n < out.size(); ++n) {
    const double t = static_cast<double>(n - 100) / kRate;
    const double p =
        pressure(paper_bubble(static_cast<double>(0.005F), static_cast<double>(0.05F)), t);
    worst = std::max(worst, std::abs(static_cast<double>(out[n]) - p / 0.01));
  }
  // A0 is 0.025 of full scale; the 1 Hz high-pass turns 600 Hz by 0.25 degrees, and swings in.
  EXPECT_LT(worst, 0.025 * 0.01);
  EXPECT_GT(worst, 0.0);
}

// Until it breaks it is the formula; then it fades within 50 ms. Without a life it rings on.
TEST(Engine, FadesACavityAfterItsLife) {
  const auto played = [](float life) {
    Engine engine(open_rig(), file_settings());
    protocol::Cavity event = cavity(0.06F);
    event.epsilon = 0.01F;
    event.life = life;
    engine.schedule({event, 100});
    return render(engine, 48000, {37}).front();
  };
  const auto for_ever = played(0.0F);
  const auto broken = played(0.15F);
  constexpr std::size_t kBreaks = 100 + 7200;
  constexpr std::size_t kOver = kBreaks + 2400;
  for (std::size_t n = 0; n < kOver; ++n) {
    const double whole = static_cast<double>(for_ever[n]);
    if (n <= kBreaks) {
      ASSERT_EQ(broken[n], for_ever[n]) << n;
    } else {
      ASSERT_LE(std::abs(static_cast<double>(broken[n])), std::abs(whole) + 0.01) << n;
    }
  }
  EXPECT_GT(std::abs(*std::max_element(for_ever.begin() + kOver, for_ever.end())), 0.02F);
  EXPECT_LT(energy({broken.begin() + 24100, broken.end()}), 1e-4 * energy(broken))
      << "half a second after its start";
}

TEST(Engine, ComponentsAddUpToTheWhole) {
  const auto events = splashes(60, 20000);
  const auto render_of = [&](unsigned components) {
    auto settings = file_settings();
    settings.components = components;
    Engine engine(floor_rig(), settings);
    for (const TimedEvent& event : events) engine.schedule(event);
    auto out = render(engine, 48000);
    EXPECT_EQ(engine.counters().limited, 0U) << "too loud for this comparison";
    return out;
  };
  const auto all = render_of(kAllComponents);
  const auto impacts = render_of(kImpacts);
  const auto bubbles = render_of(kBubbles);
  const auto cavities = render_of(kCavities);
  EXPECT_NE(impacts, bubbles);
  for (std::size_t c = 0; c < all.size(); ++c) {
    for (std::size_t n = 0; n < all[c].size(); ++n) {
      ASSERT_NEAR(all[c][n], impacts[c][n] + bubbles[c][n] + cavities[c][n], 1e-6F);
    }
  }
}

TEST(Engine, MovesTheTilesAtTheEventMost) {
  Engine engine(floor_rig(), file_settings());
  engine.schedule({bubble(0.008F, 0.1F, {2.5F * 0.305F, 1.4F * 0.305F, 0.1F}), 0});
  const auto out = render(engine, 9600);
  const auto strongest = std::max_element(
      out.begin(), out.end(), [](const auto& a, const auto& b) { return energy(a) < energy(b); });
  EXPECT_EQ(strongest - out.begin(), 1 * 6 + 2);
  EXPECT_EQ(energy(out[35]), 0.0);
}

TEST(Engine, RendersAnImpactLouderWithTheCubeOfItsSpeed) {
  const auto peak = [](float speed) {
    Engine engine(open_rig(), file_settings());
    engine.schedule({impact(speed, 4), 0});
    return loudest(render(engine, 9600).front());
  };
  const double slope = std::log(peak(1.5F) / peak(0.25F)) / std::log(6.0);
  EXPECT_NEAR(slope, 3.0, 0.001);
}

TEST(Engine, RendersAGlancingSlapByItsSpeedIntoTheWater) {
  const auto rendered = [](float speed, float approach) {
    Engine engine(open_rig(), file_settings());
    protocol::Impact slap = impact(speed, 4);
    slap.approach = approach;
    engine.schedule({slap, 0});
    return render(engine, 4800);
  };
  EXPECT_EQ(rendered(2.1F, 0.6F), rendered(0.6F, 0.6F));
  EXPECT_NE(rendered(2.1F, 0.6F), rendered(2.1F, 2.1F));
}

TEST(Engine, KeepsBodiesApart) {
  Rig rig = open_rig();
  rig.outputs.push_back(rig.outputs.front());
  rig.outputs[0].name = "left hand";
  rig.outputs[0].body = 0;
  rig.outputs[1].name = "right hand";
  rig.outputs[1].body = 1;
  Engine engine(rig, file_settings());
  engine.schedule({impact(1.0F), 0});    // body 0
  engine.schedule({bubble(0.005F), 0});  // of no body
  const auto out = render(engine, 480);
  EXPECT_NE(out[0], std::vector<float>(480, 0.0F));
  EXPECT_EQ(out[1], std::vector<float>(480, 0.0F));
  EXPECT_EQ(engine.counters().dropped_unheard, 1U);
}

TEST(Engine, RefusesAndCountsWhatItCannotRender) {
  auto settings = file_settings();
  settings.max_scheduled = 2;
  settings.components = kBubbles | kImpacts;
  Engine engine(open_rig(), settings);
  constexpr float kNan = std::numeric_limits<float>::quiet_NaN();
  EXPECT_FALSE(engine.schedule({bubble(kNan), 0}));
  EXPECT_FALSE(engine.schedule({bubble(0.0F), 0}));
  EXPECT_FALSE(engine.schedule({bubble(2.0F), 0}));
  EXPECT_FALSE(engine.schedule({bubble(0.01F, -0.1F), 0}));
  EXPECT_FALSE(engine.schedule({impact(std::numeric_limits<float>::infinity()), 0}));
  EXPECT_FALSE(engine.schedule({impact(1.0F, 0, {0.0F, kNan, 0.0F}), 0}));
  EXPECT_EQ(engine.counters().dropped_refused, 6U);
  EXPECT_FALSE(engine.schedule({cavity(0.05F), 0}));
  EXPECT_EQ(engine.counters().dropped_muted, 1U);
  EXPECT_TRUE(engine.schedule({bubble(0.01F), 0}));
  EXPECT_TRUE(engine.schedule({bubble(0.01F), 0}));
  EXPECT_FALSE(engine.schedule({bubble(0.01F), 0}));
  EXPECT_EQ(engine.counters().dropped_queue, 1U);
  EXPECT_EQ(engine.counters().scheduled, 2U);
  render(engine, 64);
  EXPECT_EQ(engine.counters().scheduled, 0U);
  EXPECT_EQ(engine.counters().voices, 2U);
  EXPECT_EQ(engine.counters().started.of<protocol::Bubble>(), 2U);
}

TEST(Engine, StartsLateEventsAtOnceAndCountsThem) {
  Engine engine(open_rig(), file_settings());
  render(engine, 1000);
  engine.schedule({bubble(0.005F), 400});
  const auto out = render(engine, 100).front();
  EXPECT_EQ(out[0], 0.0F);
  EXPECT_GT(out[1], 0.0F);
  EXPECT_EQ(engine.counters().late, 1U);
  EXPECT_EQ(engine.clock(), 1100);
}

TEST(Engine, SurvivesAFloodOfSimultaneousEvents) {
  auto settings = file_settings();
  settings.max_scheduled = 20000;
  settings.max_voices = 1024;
  Engine engine(floor_rig(), settings);
  for (int i = 0; i < 20000; ++i) {
    engine.schedule({bubble(0.01F, 0.1F, {0.9F, 0.9F, 0.0F}), 100});
  }
  const auto out = render(engine, 9600);
  const auto counters = engine.counters();
  EXPECT_EQ(
      counters.started.of<protocol::Bubble>() + counters.dropped_pool + counters.dropped_queue,
      20000U);
  EXPECT_LE(counters.voices, 1024U);
  for (const auto& channel : out) {
    for (const float v : channel) ASSERT_LE(std::abs(v), 0.9F);
  }
}

// 450,000 loud bubbles a second for half a second, and among them quiet impacts and cavities,
// twenty times a second each: none of those is dropped, what is dropped is told by its kind.
TEST(Engine, PlaysAllImpactsAndCavitiesInAFloodOfBubbles) {
  auto settings = file_settings();
  Engine engine(open_rig(), settings);
  constexpr int kBlocks = 94;
  constexpr int kBlock = 256;
  int others = 0;
  for (int block = 0; block < kBlocks; ++block) {
    const std::int64_t begin = engine.clock();
    for (int i = 0; i < 2400; ++i) {
      engine.schedule({bubble(0.03F, 0.1F), begin + i % kBlock});
    }
    if (block % 10 == 5) {
      EXPECT_TRUE(engine.schedule({impact(1.0F, block), begin + 255}));
      protocol::Cavity quiet = cavity(0.02F);
      quiet.epsilon = 0.01F;
      EXPECT_TRUE(engine.schedule({quiet, begin + 255}));
      ++others;
    }
    render(engine, kBlock);
  }
  const EngineCounters counters = engine.counters();
  EXPECT_EQ(counters.started.of<protocol::Impact>(), static_cast<std::uint64_t>(others));
  EXPECT_EQ(counters.started.of<protocol::Cavity>(), static_cast<std::uint64_t>(others));
  EXPECT_EQ(counters.without_place.of<protocol::Impact>(), 0U);
  EXPECT_EQ(counters.without_place.of<protocol::Cavity>(), 0U);
  EXPECT_GT(counters.without_place.of<protocol::Bubble>(), 0U);
  EXPECT_EQ(counters.without_place.of<protocol::Bubble>(),
            counters.dropped_pool + counters.dropped_queue);
}

// More at once than may start in one of the engine's cells, and more than may wait.
TEST(Engine, KeepsPlacesForImpactsAndCavitiesBehindBubblesOfOneMoment) {
  Engine engine(open_rig(), file_settings());
  for (int i = 0; i < 20000; ++i) engine.schedule({bubble(0.03F, 0.1F), 100});
  for (int i = 0; i < 30; ++i) {
    EXPECT_TRUE(engine.schedule({impact(1.0F, i), 100}));
    EXPECT_TRUE(engine.schedule({cavity(0.05F), 100}));
  }
  render(engine, 4800);
  EXPECT_EQ(engine.counters().started.of<protocol::Impact>(), 30U);
  EXPECT_EQ(engine.counters().started.of<protocol::Cavity>(), 30U);
}

TEST(Engine, RefusesSettingsBeyondTheirLimits) {
  const auto refused = [](auto change, const std::string& name) {
    auto settings = file_settings();
    change(settings);
    EXPECT_THAT([&] { const Engine engine(open_rig(), settings); },
                testing::ThrowsMessage<std::invalid_argument>(testing::HasSubstr(name)));
  };
  refused([](auto& s) { s.sample_rate = 0.0; }, "sample_rate");
  refused([](auto& s) { s.sample_rate = std::numeric_limits<double>::quiet_NaN(); }, "sample_rate");
  refused([](auto& s) { s.max_block = 0; }, "max_block");
  refused([](auto& s) { s.max_voices = 0; }, "max_voices");
  refused([](auto& s) { s.max_impacts = 0; }, "max_impacts");
  refused([](auto& s) { s.max_scheduled = 0; }, "max_scheduled");
  refused([](auto& s) { s.water_level = std::numeric_limits<double>::quiet_NaN(); }, "water_level");
  refused([](auto& s) { s.sound.impact.frequency = 24000.0; }, "sound.impact.frequency");
  refused([](auto& s) { s.sound.cavity.rise = std::numeric_limits<double>::infinity(); }, "sound");
  refused([](auto& s) { s.start_ramp = -1.0; }, "start_ramp");
  EXPECT_THROW(Engine(Rig{}, file_settings()), std::invalid_argument);
  Rig beyond_nyquist = open_rig();
  beyond_nyquist.outputs[0].band = {22000.0, 24000.0};
  EXPECT_THROW(Engine(beyond_nyquist, file_settings()), std::invalid_argument);
}

}  // namespace
}  // namespace splash::synth
