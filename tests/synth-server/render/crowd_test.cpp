// SPDX-License-Identifier: MIT
// Bubbles that share noise: as loud in each third of an octave as with a voice each, on each
// channel, without a click, whatever the blocks; and none where there are not so many.
#include "synth-server/render/crowd.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <map>

#include "synth-server/output/biquad.hpp"
#include "tests/synth-server/render/rendering.hpp"

namespace splash::synth {
namespace {

constexpr double kAll = 1e6;

/// So wide that no limiter acts.
Rig quiet_rig() {
  Rig rig = open_rig();
  rig.outputs[0].full_scale = 0.05;
  return rig;
}

EngineSettings crowd_settings(double singles) {
  auto settings = file_settings();
  settings.sound.cloud.singles = singles;
  settings.max_voices = 131072;
  settings.max_scheduled = 1 << 20;
  return settings;
}

/// Sizes as r^-3 from `least` [m] to 30 mm.
std::vector<TimedEvent> births(double per_second, double seconds, double least = 0.003) {
  std::vector<TimedEvent> events;
  const double part = 1.0 - std::pow(least / 0.030, 2.0);
  std::uint64_t state = 99;
  const auto draw = [&] {
    state = state * 6364136223846793005ULL + 1442695040888963407ULL;
    return static_cast<double>(state >> 11U) / 9007199254740992.0;
  };
  for (double t = 0.0; t < seconds; t -= std::log(1.0 - draw()) / per_second) {
    const auto radius = static_cast<float>(least / std::sqrt(1.0 - part * draw()));
    const auto epsilon = static_cast<float>(0.001 + 0.009 * draw());
    const protocol::Vec3 place{static_cast<float>(1.83 * draw()), static_cast<float>(1.83 * draw()),
                               0.0F};
    events.push_back({bubble(radius, epsilon, place), std::llround(t * kRate)});
  }
  return events;
}

struct Rendered {
  Channels out;
  EngineCounters counters;
};

Rendered rendered(const Rig& rig, const EngineSettings& settings,
                  const std::vector<TimedEvent>& events, int frames,
                  const std::vector<int>& blocks = {512}) {
  Engine engine(rig, settings);
  for (const TimedEvent& event : events) engine.schedule(event);
  Rendered rendered;
  rendered.out = render(engine, frames, blocks);
  rendered.counters = engine.counters();
  EXPECT_EQ(rendered.counters.limited, 0U);
  return rendered;
}

/// In dB, of the samples from `from` on; `third`: thirds of an octave over 1 kHz.
double level_db(const std::vector<float>& samples, int third, std::size_t from) {
  const double frequency = 1000.0 * std::exp2(third / 3.0);
  BandFilter filter({frequency * std::exp2(-1.0 / 6.0), frequency * std::exp2(1.0 / 6.0)}, kRate);
  double sum = 0.0;
  for (std::size_t n = 0; n < samples.size(); ++n) {
    const double out = filter.process(static_cast<double>(samples[n]));
    if (n >= from) sum += out * out;
  }
  return 10.0 * std::log10(sum);
}

TEST(Crowd, IsAsLoudInEachThirdOfAnOctaveAsWithAVoiceEach) {
  constexpr int kSeconds = 6;
  for (const double rate : {5000.0, 10000.0, 20000.0, 40000.0}) {
    const auto events = births(rate, kSeconds);
    const auto frames = static_cast<int>(kSeconds * kRate);
    const auto voices = rendered(quiet_rig(), crowd_settings(kAll), events, frames);
    const auto crowd = rendered(quiet_rig(), crowd_settings(rate / 4.0), events, frames);
    EXPECT_EQ(crowd.counters.started.of<protocol::Bubble>(),
              voices.counters.started.of<protocol::Bubble>());
    EXPECT_NEAR(static_cast<double>(crowd.counters.crowded) /
                    static_cast<double>(crowd.counters.started.of<protocol::Bubble>()),
                0.75, 0.02);
    std::map<int, double> levels;
    for (int third = -11; third <= 1; ++third) {
      levels[third] = level_db(voices.out[0], third, 24000);
    }
    const double top =
        std::max_element(levels.begin(), levels.end(), [](const auto& a, const auto& b) {
          return a.second < b.second;
        })->second;
    double most = 0.0;
    for (const auto& [third, level] : levels) {
      const double off = level_db(crowd.out[0], third, 24000) - level;
      EXPECT_GT(level, top - 20.0) << "they sound in all of these thirds";
      EXPECT_NEAR(off, 0.0, 1.0) << rate << "/s, third " << third << " over 1 kHz";
      most = std::max(most, std::abs(off));
    }
    std::printf("%.0f/s: within %.1f dB\n", rate, most);
  }
}

TEST(Crowd, IsNoneWhereThereAreNotSoMany) {
  const auto events = births(9500.0, 2.0);
  const auto all = rendered(quiet_rig(), crowd_settings(kAll), events, 96000);
  const auto some = rendered(quiet_rig(), crowd_settings(10000.0), events, 96000);
  EXPECT_EQ(some.counters.crowded, 0U);
  EXPECT_EQ(some.out, all.out);
}

TEST(Crowd, LeavesAsManySingleAsTheSoundSays) {
  const auto count = [](double rate) {
    const auto counters =
        rendered(quiet_rig(), crowd_settings(10000.0), births(rate, 3.0), 144000).counters;
    return static_cast<double>(counters.started.of<protocol::Bubble>() - counters.crowded) / 3.0;
  };
  EXPECT_NEAR(count(20000.0), 10000.0, 500.0);
  EXPECT_NEAR(count(40000.0), 10000.0, 1000.0) << "more at first, before the rate is known";
}

TEST(Crowd, IsHeardOnEachTileAsTheBubblesAre) {
  const auto events = births(20000.0, 4.0);
  const auto voices = rendered(floor_rig(), crowd_settings(kAll), events, 192000);
  const auto crowd = rendered(floor_rig(), crowd_settings(2000.0), events, 192000);
  for (std::size_t tile = 0; tile < 36; ++tile) {
    EXPECT_NEAR(10.0 * std::log10(energy(crowd.out[tile]) / energy(voices.out[tile])), 0.0, 1.0)
        << tile;
  }
  // Neighbours have noise of their own: what they share is what single bubbles give both.
  double product = 0.0;
  for (std::size_t n = 0; n < crowd.out[0].size(); ++n) {
    product += static_cast<double>(crowd.out[14][n]) * static_cast<double>(crowd.out[15][n]);
  }
  EXPECT_LT(std::abs(product), 0.3 * std::sqrt(energy(crowd.out[14]) * energy(crowd.out[15])));
}

/// 400 large bubbles at one moment, among many weak ones, so that the noise is there before.
TEST(Crowd, ComesWithoutAClick) {
  std::vector<TimedEvent> events;
  for (TimedEvent event : births(5000.0, 0.5, 0.01)) {
    std::get<protocol::Bubble>(event.event).epsilon = 1e-5F;
    events.push_back(event);
  }
  for (TimedEvent event : births(400.0, 1.0, 0.01)) {
    event.sample = 12000;
    events.push_back(event);
  }
  const Rendered played = rendered(quiet_rig(), crowd_settings(100.0), events, 24000);
  BandFilter filter({4000.0, kRate}, kRate);  // what clicks is heard there, octaves over the noise
  double above = 0.0;
  for (const float s : played.out[0]) above += std::pow(filter.process(static_cast<double>(s)), 2);
  EXPECT_LT(10.0 * std::log10(above / energy(played.out[0])), -50.0);
}

TEST(Crowd, IsTheSameInBlocksOfAnySizeAndEnds) {
  Rig rig = quiet_rig();
  rig.outputs[0].band.low = 40.0;
  const auto events = births(40000.0, 0.4);
  const auto played = [&](const std::vector<int>& blocks) {
    return rendered(rig, crowd_settings(4000.0), events, 150000, blocks).out;
  };
  const Channels whole = played({512});
  EXPECT_EQ(played({64}), whole);
  EXPECT_EQ(played({1, 7, 100, 333}), whole);
  for (std::size_t n = 140000; n < whole[0].size(); ++n) ASSERT_EQ(whole[0][n], 0.0F) << n;
}

TEST(Crowd, TakesNoVoicesAndNoCavities) {
  auto events = births(40000.0, 2.0);
  for (int i = 0; i < 20; ++i) events.push_back({cavity(0.05F), 48000 + i * 100});
  const auto crowd = rendered(quiet_rig(), crowd_settings(10000.0), events, 96000).counters;
  const auto quarter =
      rendered(quiet_rig(), crowd_settings(kAll), births(10000.0, 2.0), 96000).counters;
  EXPECT_EQ(crowd.started.of<protocol::Cavity>(), 20U);
  EXPECT_LT(crowd.voices, quarter.voices + quarter.voices / 10 + 20);
}

/// At 0.1 m the pitch is 30 Hz.
TEST(Crowd, LeavesVoicesToBubblesUnderItsBands) {
  std::vector<TimedEvent> events;
  for (std::int64_t i = 0; i < 4000; ++i) events.push_back({bubble(0.1F, 0.001F), 4 * i});
  const auto counters = rendered(quiet_rig(), crowd_settings(1000.0), events, 16000).counters;
  EXPECT_EQ(counters.started.of<protocol::Bubble>(), 4000U);
  EXPECT_EQ(counters.crowded, 0U);
}

}  // namespace
}  // namespace splash::synth
