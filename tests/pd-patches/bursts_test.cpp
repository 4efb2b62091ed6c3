// SPDX-License-Identifier: MIT
// Impacts are noise: the two synths draw different numbers, so their bursts are compared by energy,
// in bands and in slices of time, over 480 of them. One burst's energy in a band 60 Hz wide has a
// standard deviation of about 2.5 dB; the difference of two means of 480 has one of 0.16 dB.
#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <iostream>
#include <numbers>

#include "tests/pd-patches/rendering.hpp"

namespace splash::pd {
namespace {

constexpr double kTolerance = 0.6;  // [dB]
constexpr int kSalvos = 16;
constexpr std::int64_t kSalvo = 33600;  ///< samples between salvos: 0.7 s
constexpr std::int64_t kFrames = kSalvos * kSalvo;

/// Band-pass biquad (R. Bristow-Johnson, Audio EQ Cookbook), run twice over a copy.
std::vector<double> band_pass(std::vector<double> x, double frequency, double q) {
  const double w = 2.0 * std::numbers::pi * frequency / kRate;
  const double alpha = std::sin(w) / (2.0 * q);
  for (int pass = 0; pass < 2; ++pass) {
    double first = 0.0;
    double second = 0.0;
    for (double& sample : x) {
      const double in = alpha / (1.0 + alpha) * sample;
      const double out = in + first;
      first = second + 2.0 * std::cos(w) / (1.0 + alpha) * out;
      second = -in - (1.0 - alpha) / (1.0 + alpha) * out;
      sample = out;
    }
  }
  return x;
}

double energy(const std::vector<double>& x) {
  double sum = 0.0;
  for (const double sample : x) sum += sample * sample;
  return sum;
}

std::vector<double> widen(const std::vector<float>& x) {
  return {x.begin(), x.end()};
}

/// Energy of all channels around `frequency`.
double band_energy(const Channels& channels, double frequency) {
  double sum = 0.0;
  for (const auto& channel : channels) sum += energy(band_pass(widen(channel), frequency, 3.0));
  return sum;
}

/// Energy of all channels between two times after the salvos [s].
double slice_energy(const Channels& channels, double from, double to) {
  double sum = 0.0;
  for (const auto& channel : channels) {
    for (std::int64_t salvo = 0; salvo < kSalvos; ++salvo) {
      const auto begin = channel.begin() + salvo * kSalvo;
      sum += energy({begin + std::llround(from * kRate), begin + std::llround(to * kRate)});
    }
  }
  return sum;
}

std::vector<protocol::LogEntry> salvos() {
  std::vector<EventAt> events;
  for (int salvo = 0; salvo < kSalvos; ++salvo) {
    for (int tile = 0; tile < 30; ++tile) {
      const int row = tile / 6;
      const protocol::Vec3 place = {(static_cast<float>(tile % 6) + 0.5F) * 0.305F,
                                    (static_cast<float>(row) + 0.5F) * 0.305F, 0.0F};
      events.push_back(
          {salvo * 0.7, protocol::Impact{salvo * 30 + tile, 0, 1.2F, 1.0F, place, 0.0F}});
    }
  }
  return make_log(events);
}

double power_decibels(double ratio) {
  return 10.0 * std::log10(ratio);
}

TEST(Bursts, HaveTheSameEnergyInEveryBandAndAtEveryTime) {
  const auto log = salvos();
  const auto [pd, synth] = render_both(log, kTiles, kFrames);
  for (const double frequency : {120.0, 250.0, 420.0, 550.0, 700.0}) {
    const double level = power_decibels(band_energy(pd, frequency) / band_energy(synth, frequency));
    std::cout << frequency << " Hz: " << level << " dB\n";
    EXPECT_NEAR(level, 0.0, kTolerance) << frequency << " Hz";
  }
  constexpr std::array<double, 5> kTimes = {0.0, 0.02, 0.06, 0.15, 0.35};
  for (std::size_t k = 0; k + 1 < kTimes.size(); ++k) {
    const double level = power_decibels(slice_energy(pd, kTimes[k], kTimes[k + 1]) /
                                        slice_energy(synth, kTimes[k], kTimes[k + 1]));
    std::cout << kTimes[k] << " s: " << level << " dB\n";
    EXPECT_NEAR(level, 0.0, kTolerance) << "from " << kTimes[k] << " s";
  }
}

TEST(Bursts, GrowWithTheCubeOfTheSpeed) {
  const auto burst = [](float speed) {
    const auto log =
        make_log({{0.0, protocol::Impact{1, 0, speed, speed, {0.9F, 0.9F, 0.0F}, 0.0F}}});
    double sum = 0.0;
    for (const auto& channel : render_with_pd(log, kTiles, 24000)) sum += energy(widen(channel));
    return sum;
  };
  // Pd's noise is the same in every run, so the two bursts differ by their level alone.
  EXPECT_NEAR(power_decibels(burst(1.6F) / burst(0.8F)), 60.0 * std::log10(2.0), 0.01);
}

}  // namespace
}  // namespace splash::pd
