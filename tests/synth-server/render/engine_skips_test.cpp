// SPDX-License-Identifier: MIT
// What the engine leaves undone, each with its counter, its switch and the bound of the difference
// that it makes.
#include <gtest/gtest.h>

#include <cmath>
#include <complex>
#include <cstdio>
#include <numbers>

#include "synth-server/render/audibility.hpp"
#include "tests/synth-server/render/rendering.hpp"

namespace splash::synth {
namespace {

TEST(Engine, SkipsSilentChannelsWithoutChangingASample) {
  const TimedEvent events[] = {{bubble(0.006F, 0.05F, {0.2F, 0.2F, 0.0F}), 1000},
                               {impact(1.0F, 1, {1.5F, 1.5F, 0.0F}), 90000}};
  auto settings = file_settings();
  Engine skipping(floor_rig(), settings);
  settings.skip_silent = false;
  Engine diligent(floor_rig(), settings);
  for (const TimedEvent& event : events) {
    skipping.schedule(event);
    diligent.schedule(event);
  }
  EXPECT_EQ(render(skipping, 192000, {480}), render(diligent, 192000, {480}));
  const auto counters = skipping.counters();
  EXPECT_EQ(counters.cells, 3000U);
  EXPECT_GT(counters.channels_skipped, counters.cells * 36 / 2);
  EXPECT_EQ(diligent.counters().channels_skipped, 0U);
}

TEST(Engine, LeavesOutBubblesAboveTheBandOfEachOutput) {
  Rig rig = floor_rig();
  rig.outputs.push_back(open_rig().outputs.front());
  Engine engine(rig, file_settings());
  engine.schedule({bubble(0.0039F), 0});  // 769 Hz: heard, not felt
  const auto out = render(engine, 4800);
  for (std::size_t tile = 0; tile < 36; ++tile) ASSERT_EQ(energy(out[tile]), 0.0) << tile;
  EXPECT_GT(*std::max_element(out[36].begin(), out[36].end()), 0.01F);
  EXPECT_EQ(engine.counters().started.of<protocol::Bubble>(), 1U);

  Engine floor(floor_rig(), file_settings());
  floor.schedule({bubble(0.0039F), 0});
  floor.schedule({bubble(0.0041F), 0});
  render(floor, 4800);
  EXPECT_EQ(floor.counters().dropped_band, 1U);
  EXPECT_EQ(floor.counters().started.of<protocol::Bubble>(), 1U);
}

TEST(Engine, NeverStartsWhatNyquistForbids) {
  Rig rig = open_rig();
  rig.outputs[0].band.high = 40000.0;  // so that the band has no say
  Engine engine(rig, file_settings());
  engine.schedule({bubble(0.00012F, 0.1F), 0});  // 25 kHz at 48 kHz
  const auto out = render(engine, 480).front();
  EXPECT_EQ(out, std::vector<float>(480, 0.0F));
  EXPECT_EQ(engine.counters().dropped_band, 1U);
}

TEST(Skips, OfBubblesAboveTheBandCostNothingThatTheBandWouldHaveLetThrough) {
  // Born at the band's end or above and rising from there: 3 dB down from the first sample on.
  for (const float radius : {0.00399F, 0.0030F, 0.0020F}) {
    auto settings = file_settings();
    Engine skipping(floor_rig(), settings);
    settings.skip_out_of_band = false;
    Engine diligent(floor_rig(), settings);
    skipping.schedule({bubble(radius, 0.1F, {0.15F, 0.15F, 0.0F}), 0});
    diligent.schedule({bubble(radius, 0.1F, {0.15F, 0.15F, 0.0F}), 0});
    EXPECT_EQ(loudest(render(skipping, 4800)[0]), 0.0);
    EXPECT_EQ(skipping.counters().dropped_band, 1U);
    EXPECT_EQ(diligent.counters().dropped_band, 0U);
    const double amplitude = 0.1 * static_cast<double>(radius) / 0.01;
    const double octaves = std::log2(3.0 / static_cast<double>(radius) / 750.0);
    const double heard = loudest(render(diligent, 4800)[0]);
    EXPECT_LT(heard, amplitude * std::pow(10.0, (-3.0 - 9.0 * octaves) / 20.0)) << radius;
    EXPECT_GT(heard, 0.0);
  }
}

/// The amplitude of a channel at a frequency around a sample, in a Hann window of 100 ms.
double amplitude_at(const std::vector<float>& x, std::size_t from, double frequency) {
  constexpr std::size_t kWindow = 4800;
  std::complex<double> sum = 0.0;
  for (std::size_t n = 0; n < kWindow; ++n) {
    const double turn = 2.0 * std::numbers::pi * static_cast<double>(n);
    const double window = 1.0 - std::cos(turn / kWindow);
    sum += window * static_cast<double>(x[from + n]) * std::polar(1.0, -turn * frequency / kRate);
  }
  return 2.0 * std::abs(sum) / kWindow;
}

std::vector<float> difference(const std::vector<float>& a, const std::vector<float>& b) {
  std::vector<float> out(a.size());
  for (std::size_t n = 0; n < a.size(); ++n) out[n] = a[n] - b[n];
  return out;
}

struct Felt {
  std::string name;
  Rig rig;
  double level_db = 0.0;  ///< just felt at 250 Hz [dB re full scale]
  double voices = 0.0;    ///< at most this part of them is left
};

std::vector<Felt> floors() {
  Rig dull = floor_rig();
  dull.outputs[0].threshold = {Sense::touch, -44.0};
  const Rig shipped = shipped_rig("tiles36");
  return {{"dull", dull, -44.0, 0.75}, {"shipped", shipped, -52.0, 0.9}};
}

class UnfeltVoices : public testing::TestWithParam<Felt> {};
INSTANTIATE_TEST_SUITE_P(Floors, UnfeltVoices, testing::ValuesIn(floors()),
                         [](const auto& felt) { return felt.param.name; });

TEST_P(UnfeltVoices, StayBelowTheThresholdOfTouch) {
  const Rig& rig = GetParam().rig;
  struct Heard {
    Channels out;
    std::uint64_t dropped = 0;
    std::uint64_t voices = 0;
  };
  const auto render_with = [&](bool skip) {
    auto settings = file_settings();
    settings.skip_unfelt = skip;
    Engine engine(rig, settings);
    for (const TimedEvent& event : splashes(1500, 48000)) engine.schedule(event);
    Heard all{render(engine, 48000), engine.counters().dropped_unheard, engine.counters().voices};
    const auto rest = render(engine, 24000);
    for (std::size_t c = 0; c < all.out.size(); ++c) {
      all.out[c].insert(all.out[c].end(), rest[c].begin(), rest[c].end());
    }
    EXPECT_EQ(engine.counters().limited, 0U);
    return all;
  };
  const Heard skipping = render_with(true);
  const Heard diligent = render_with(false);
  EXPECT_GT(skipping.dropped, 5U);
  EXPECT_EQ(diligent.dropped, 0U);
  EXPECT_LT(static_cast<double>(skipping.voices),
            GetParam().voices * static_cast<double>(diligent.voices))
      << "they also end earlier";
  double nearest_db = -200.0;
  for (const std::size_t tile : {0U, 14U, 21U, 35U}) {
    const auto left_out = difference(diligent.out[tile], skipping.out[tile]);
    ASSERT_GT(energy(left_out), 0.0);
    for (std::size_t from = 0; from + 4800 <= left_out.size(); from += 2400) {
      for (double f = 25.0; f < 750.0; f *= 1.26) {
        const double limit_db = GetParam().level_db + touch_threshold_db(f);
        const double level_db = 20.0 * std::log10(amplitude_at(left_out, from, f) + 1e-12);
        nearest_db = std::max(nearest_db, level_db - limit_db);
        ASSERT_LT(level_db, limit_db) << f << " Hz, tile " << tile;
      }
    }
  }
  std::printf("left out: at most %.1f dB re the threshold\n", nearest_db);
  EXPECT_GT(nearest_db, -40.0) << "the test's scene is too quiet to prove anything";
}

}  // namespace
}  // namespace splash::synth
