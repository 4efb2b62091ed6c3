// SPDX-License-Identifier: MIT
#include "synth-server/figure/spectrogram.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <stdexcept>

namespace splash::synth {
namespace {

constexpr double kRate = 8000.0;  // [Hz]

std::vector<float> sine(double frequency, double amplitude, double seconds) {
  std::vector<float> signal(static_cast<std::size_t>(seconds * kRate));
  for (std::size_t i = 0; i < signal.size(); ++i) {
    const double t = static_cast<double>(i) / kRate;
    signal[i] = static_cast<float>(amplitude * std::sin(2.0 * std::numbers::pi * frequency * t));
  }
  return signal;
}

/// Frequency of the loudest row of a column [Hz].
double ridge(const Spectrogram& spectrum, std::size_t column) {
  std::size_t best = 0;
  for (std::size_t r = 1; r < spectrum.rows; ++r) {
    if (spectrum.at(r, column) > spectrum.at(best, column)) best = r;
  }
  return spectrum.frequency[best];
}

std::size_t nearest_row(const Spectrogram& spectrum, double frequency) {
  const auto above =
      std::lower_bound(spectrum.frequency.begin(), spectrum.frequency.end(), frequency);
  return static_cast<std::size_t>(above - spectrum.frequency.begin());
}

/// Hann's window loses 1.42 dB half a bin off its peak, and a sixteenth of that with bins four
/// times as dense by zero padding [dB].
constexpr double kScalloping = 1.42 / 16.0;

TEST(Spectrogram, FullScaleSineReadsZeroDecibels) {
  SpectrogramSettings settings;
  settings.columns = 9;
  for (const double frequency : {60.0, 100.0, 420.0, 900.0}) {
    const Spectrogram spectrum = spectrogram(sine(frequency, 1.0, 2.0), kRate, settings);
    EXPECT_NEAR(ridge(spectrum, 4) / frequency, 1.0, 0.01) << frequency;
    SpectrogramSettings exact = settings;  // whose first row is the sine's own frequency
    exact.lowest = frequency;
    EXPECT_NEAR(spectrogram(sine(frequency, 1.0, 2.0), kRate, exact).at(0, 4), 0.0, kScalloping);
  }
}

TEST(Spectrogram, LevelFollowsAmplitude) {
  SpectrogramSettings settings;
  settings.columns = 5;
  const Spectrogram spectrum = spectrogram(sine(200.0, 0.01, 1.0), kRate, settings);
  EXPECT_NEAR(spectrum.at(nearest_row(spectrum, 200.0), 2), -40.0, 0.2);
  EXPECT_LT(spectrum.at(nearest_row(spectrum, 400.0), 2), -90.0);  // Hann's side lobes fall fast
}

// f(t) = 50 Hz + 200 Hz/s * t: the phase is 2 pi (50 t + 100 t^2).
TEST(Spectrogram, ChirpShowsItsRidge) {
  std::vector<float> signal(static_cast<std::size_t>(2.0 * kRate));
  for (std::size_t i = 0; i < signal.size(); ++i) {
    const double t = static_cast<double>(i) / kRate;
    signal[i] = static_cast<float>(std::sin(2.0 * std::numbers::pi * (50.0 * t + 100.0 * t * t)));
  }
  SpectrogramSettings settings;
  settings.columns = 40;
  const Spectrogram spectrum = spectrogram(signal, kRate, settings);
  for (std::size_t c = 3; c + 3 < settings.columns; ++c) {
    const double expected = 50.0 + 200.0 * spectrum.time[c];
    EXPECT_NEAR(ridge(spectrum, c), expected, 0.02 * expected + 2.0) << spectrum.time[c] << " s";
  }
}

TEST(Spectrogram, RowsAreLogarithmicAndColumnsShareTheSpan) {
  SpectrogramSettings settings;
  settings.rows = 3;
  settings.columns = 4;
  settings.from = 0.5;
  settings.to = 0.9;
  const Spectrogram spectrum = spectrogram(sine(100.0, 1.0, 1.0), kRate, settings);
  EXPECT_DOUBLE_EQ(spectrum.frequency[0], 10.0);
  EXPECT_DOUBLE_EQ(spectrum.frequency[1], 100.0);
  EXPECT_DOUBLE_EQ(spectrum.frequency[2], 1000.0);
  EXPECT_NEAR(spectrum.time.front(), 0.55, 1e-12);
  EXPECT_NEAR(spectrum.time.back(), 0.85, 1e-12);
  EXPECT_NEAR(spectrum.at(1, 3), 0.0, 0.2);  // the signal goes on beyond the span: no edge
}

TEST(Spectrogram, SilenceReadsTheFloor) {
  SpectrogramSettings settings;
  settings.columns = 3;
  const Spectrogram spectrum = spectrogram(std::vector<float>(800, 0.0F), kRate, settings);
  for (const float level : spectrum.level_db) EXPECT_EQ(level, -200.0F);
}

TEST(Spectrogram, RefusesSettingsThatMakeNoSense) {
  const std::vector<float> signal = sine(100.0, 1.0, 0.1);
  const auto refused = [&](auto change) {
    SpectrogramSettings settings;
    change(settings);
    EXPECT_THROW(spectrogram(signal, kRate, settings), std::invalid_argument);
  };
  refused([](SpectrogramSettings& s) { s.rows = 1; });
  refused([](SpectrogramSettings& s) { s.columns = 0; });
  refused([](SpectrogramSettings& s) { s.lowest = 0.0; });
  refused([](SpectrogramSettings& s) { s.highest = 5.0; });
  refused([](SpectrogramSettings& s) { s.highest = 4001.0; });
  refused([](SpectrogramSettings& s) { s.from = -1.0; });
  refused([](SpectrogramSettings& s) { s.to = 0.0; });
}

}  // namespace
}  // namespace splash::synth
