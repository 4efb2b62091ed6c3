// SPDX-License-Identifier: MIT
// The noise of bubbles too small for the simulator: its energy by band against the law integrated
// bubble by bubble, where it is heard, and that blocks make no difference.
#include "synth-server/render/fine_water.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <random>

#include "synth-server/voices/bubble_tone.hpp"
#include "synth-server/voices/resonator.hpp"
#include "tests/synth-server/render/rendering.hpp"

namespace splash::synth {
namespace {

/// Whose filters come to rest soon.
Rig wide_rig() {
  Rig rig = open_rig();
  rig.outputs[0].band.low = 40.0;
  return rig;
}

EngineSettings fine_settings() {
  auto settings = file_settings();
  settings.sound.fine.amount = 1.0;
  return settings;
}

/// Energy of closed-form bubbles of a band, drawn by the law of sizes: a Monte Carlo reference.
double drawn_energy(std::size_t band) {
  const double low = 3.0 / (fine_frequency(band) * std::exp2(1.0 / 6.0));
  const double high = 3.0 / (fine_frequency(band) * std::exp2(-1.0 / 6.0));
  const auto law = [](double r) {
    return r < 0.001 ? std::pow(r / 0.001, -1.5) : std::pow(r / 0.001, -10.0 / 3.0);
  };
  double told = 0.0;  // by the trapezoidal rule
  constexpr int kSteps = 20000;
  for (int i = 0; i <= kSteps; ++i) {
    told += law(0.003 + 0.027 * i / kSteps) * (i % kSteps == 0 ? 0.5 : 1.0) * 0.027 / kSteps;
  }
  std::mt19937_64 random(5);
  std::uniform_real_distribution<double> draw(low, high);
  constexpr int kBubbles = 150;
  double energy = 0.0;
  for (int i = 0; i < kBubbles; ++i) {
    const double r = draw(random);
    const BubbleTone tone = bubble_tone({.rise = 0.0}, r, 1.0, 0.0);
    constexpr double kStep = 1.0 / 200000.0;
    double sum = 0.0;
    for (int n = 0; n < 12000; ++n) sum += std::pow(pressure(tone, n * kStep), 2) * kStep;
    energy += law(r) / told * (high - low) * sum / kBubbles;
  }
  return energy;
}

TEST(FineWater, HasTheEnergyOfTheBubblesItStandsFor) {
  for (const std::size_t band : {0U, 4U, 7U, 11U}) {
    EXPECT_NEAR(fine_energy({}, band) / drawn_energy(band), 1.0, 0.06) << band;
  }
}

/// Of a bubble that itself is out of what is counted: it lies far under 1 kHz.
TEST(FineWater, PlaysThatEnergyForEachBubble) {
  constexpr int kBubbles = 60;
  constexpr int kApart = 4800;
  double sums[kFineBands] = {};
  for (const double amount : {1.0, 0.0}) {
    auto settings = fine_settings();
    settings.sound.fine.amount = 30.0 * amount;
    settings.sound.bubble.damping = 5.0;
    Engine engine(open_rig(), settings);
    std::vector<Resonator> filters;
    for (std::size_t b = 0; b < kFineBands; ++b) {
      filters.emplace_back(fine_frequency(b), 4.318, kRate);
    }
    for (int i = 0; i < kBubbles; ++i) engine.schedule({bubble(0.1F, 0.001F), i * kApart});
    const auto out = render(engine, kBubbles * kApart)[0];
    for (const float s : out) {
      for (std::size_t b = 0; b < kFineBands; ++b) {
        sums[b] += (amount > 0.0 ? 1.0 : -1.0) *
                   std::pow(filters[b].process(static_cast<double>(s)), 2) / kRate;
      }
    }
  }
  // The filters of the test, which keep white noise's variance, hear each band and its neighbours.
  ToneSound sound;
  sound.damping = 5.0;
  for (const std::size_t heard : {1U, 5U, 10U}) {
    double wanted = 0.0;
    const Resonator filter(fine_frequency(heard), 4.318, kRate);
    constexpr double kStep = 5.0;
    for (double f = kStep; f < 0.5 * kRate; f += kStep) {
      double amplitude = 0.0;  // one noise feeds all bands: they add up before they are squared
      double quadrature = 0.0;
      for (std::size_t b = 0; b < kFineBands; ++b) {
        const Resonator band(fine_frequency(b), 4.318, kRate);
        const double size = band.response(f, kRate) * std::sqrt(fine_energy(sound, b));
        const double turn = std::atan(4.318 * (fine_frequency(b) / f - f / fine_frequency(b)));
        amplitude += size * std::cos(turn);
        quadrature += size * std::sin(turn);
      }
      const double part = std::pow(filter.response(f, kRate), 2);
      wanted += part * (amplitude * amplitude + quadrature * quadrature) * kStep / (0.5 * kRate);
    }
    wanted *= std::pow(30.0 * 0.001 / 0.01, 2);  // amount, epsilon, full scale
    EXPECT_NEAR(10.0 * std::log10(sums[heard] / kBubbles / wanted), 0.0, 1.0) << heard;
  }
}

TEST(FineWater, IsTheSameInBlocksOfAnySize) {
  const auto played = [](const std::vector<int>& blocks) {
    Engine engine(open_rig(), fine_settings());
    for (const TimedEvent& event : splashes(300, 20000)) engine.schedule(event);
    return render(engine, 24000, blocks);
  };
  const Channels whole = played({512});
  EXPECT_EQ(played({64}), whole);
  EXPECT_EQ(played({1, 7, 100, 333}), whole);
}

TEST(FineWater, IsHeardWhereTheBandReachesAloneAndEnds) {
  const auto played = [](const Rig& rig, double amount) {
    auto settings = fine_settings();
    settings.sound.fine.amount = amount;
    Engine engine(rig, settings);
    engine.schedule({bubble(0.003F, 0.1F, {0.9F, 0.9F, 0.0F}), 0});
    return render(engine, 48000);
  };
  EXPECT_EQ(played(floor_rig(), 1.0), played(floor_rig(), 0.0)) << "tiles end at 750 Hz";
  const auto with = played(wide_rig(), 1.0)[0];
  EXPECT_NE(with, played(wide_rig(), 0.0)[0]);
  for (std::size_t n = 40000; n < with.size(); ++n) ASSERT_EQ(with[n], 0.0F) << n;
}

TEST(FineWater, FallsSilentWithTheBubbles) {
  Engine engine(wide_rig(), fine_settings());
  for (int i = 0; i < 100; ++i) engine.schedule({bubble(0.003F, 0.1F), i * 100});
  render(engine, 10000);
  engine.clear();
  const auto after = render(engine, 48000)[0];
  for (std::size_t n = 40000; n < after.size(); ++n) ASSERT_EQ(after[n], 0.0F) << n;
}

}  // namespace
}  // namespace splash::synth
